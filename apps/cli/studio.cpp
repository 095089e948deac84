// `surefoot studio`: serves the built app and a project folder to a browser on this machine.

#include "command.h"

#include <surefoot/base/error.h>

#include <server/server.h>

#include <fmt/format.h>

#include <spawn.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

extern char** environ;

namespace surefoot::cli {

namespace {

namespace fs = std::filesystem;

struct StudioOptions {
    std::string project, app;
    int port = 0;
    bool no_open = false;
};

/// Shows the address in the desktop's browser, where there is a desktop. What becomes of it is not waited for.
void open_browser(const std::string& address) {
    if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return;
    std::string program = "xdg-open", argument = address;
    char* arguments[] = {program.data(), argument.data(), nullptr};
    pid_t process = 0;
    if (posix_spawnp(&process, program.c_str(), nullptr, nullptr, arguments, environ) != 0)
        fmt::print(stderr, "no browser could be started; open the address yourself\n");
}

/// A project may be named by its folder or its file.
std::optional<fs::path> folder_of(const std::string& project) {
    if (project.empty()) return {};
    const fs::path path = project;
    return path.filename() == "project.json" ? (path.has_parent_path() ? path.parent_path() : fs::path(".")) : path;
}

fs::path this_program() {
    std::error_code error;
    const fs::path path = fs::read_symlink("/proc/self/exe", error);
    if (error) throw Error("the program does not know where it lies", "", "name the built studio with --app");
    return path;
}

int run(const StudioOptions& options) {
    studio::ServerOptions server_options;
    server_options.app = options.app.empty() ? studio::find_app(this_program()) : fs::path(options.app);
    server_options.project = folder_of(options.project);
    server_options.port = options.port;
    studio::Server server(server_options);
    fmt::print("{}\n", server.address());
    std::fflush(stdout);
    fmt::print(stderr, "the studio runs at this address until it is interrupted (Ctrl+C)\n");
    if (!options.no_open) open_browser(server.address());
    server.run();
    return 0;
}

}  // namespace

extern const Command k_studio;
const Command k_studio{
    "studio", "Open the studio in the browser: see characters, steer and shape them", [](CLI::App& app) {
        auto options = std::make_shared<StudioOptions>();
        app.add_option("PROJECT", options->project,
                       "A project made by 'surefoot author' (its folder or file); none: the default character");
        app.add_option("--port", options->port, "Of 127.0.0.1; any free one")->check(CLI::Range(0, 65535));
        app.add_flag("--no-open", options->no_open, "Print the address, open no browser");
        app.add_option("--app", options->app, "The built studio, where it does not lie beside the program");
        return [options] { return run(*options); };
    }};

}  // namespace surefoot::cli
