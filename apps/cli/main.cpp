// The `surefoot` program: finds the subcommand, runs it, turns errors into a message and exit code 2.

#include "command.h"

#include <surefoot/base/error.h>
#include <surefoot/host/files.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>

namespace surefoot::cli {

// Each is defined in the file of its name beside this one, the edits in edit.cpp.
extern const Command k_analyze, k_author, k_lint, k_fix, k_walk;
extern const Command k_convert, k_mirror, k_reverse, k_cut, k_resample, k_retime, k_straighten, k_clean, k_roles;
extern const Command k_retarget, k_fit, k_gait, k_rig, k_bake, k_bench, k_studio;

namespace {

/// Results go to standard output, and a full disk or closed pipe behind it must not pass for success.
int finish_output(int code) {
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
    std::fprintf(stderr, "surefoot: standard output cannot be written: %s; check that its disk has space\n",
                 std::strerror(errno));
    return 2;
}

/// CLI11 asks for a subcommand before it looks at what was given instead of one.
void check_subcommand(const CLI::App& app, int argc, char** argv) {
    if (argc < 2 || argv[1][0] == '-') return;
    for (const CLI::App* sub : app.get_subcommands(nullptr))
        if (sub->get_name() == argv[1]) return;
    throw surefoot::Error(std::string("there is no subcommand '") + argv[1] + "'", {}, "see surefoot --help");
}

}  // namespace
}  // namespace surefoot::cli

int main(int argc, char** argv) {
    using namespace surefoot::cli;
    CLI::App app{
        "Surefoot: characters that walk where you steer, at the speed you ask for, with their feet on the ground"};
    app.set_version_flag("--version", std::string("surefoot ") + SUREFOOT_VERSION);
    app.require_subcommand(1);

    std::function<int()> chosen;
    const Command* commands[] = {&k_analyze, &k_author, &k_lint,     &k_fix,    &k_walk,       &k_convert, &k_mirror,
                                 &k_reverse, &k_cut,    &k_resample, &k_retime, &k_straighten, &k_clean,   &k_retarget,
                                 &k_fit,     &k_roles,  &k_gait,     &k_rig,    &k_bake,       &k_bench,   &k_studio};
    for (const Command* command : commands) {
        CLI::App* sub = app.add_subcommand(command->name, command->help);
        const auto run = command->define(*sub);
        sub->final_callback([&chosen, run] { chosen = run; });
    }
    surefoot::remove_temporaries_on_signals();
    try {
        check_subcommand(app, argc, argv);
        app.parse(argc, argv);
        return finish_output(chosen ? chosen() : 2);
    } catch (const CLI::ParseError& error) {
        return finish_output(app.exit(error) == 0 ? 0 : 2);
    } catch (const surefoot::Error& error) {
        std::fprintf(stderr, "surefoot: %s\n", error.what());
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "surefoot: out of memory; work on fewer or shorter clips at a time\n");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "surefoot: %s\n", error.what());
    }
    return 2;
}
