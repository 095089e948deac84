#include "server.h"

#include <surefoot/base/error.h>
#include <surefoot/host/files.h>

#include <httplib.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>
#include <mutex>
#include <random>
#include <string_view>

namespace surefoot::studio {

namespace fs = std::filesystem;

namespace {

constexpr const char* k_loopback = "127.0.0.1";
constexpr std::string_view k_api = "/api/", k_files = "/api/files/";

// vite writes one style sheet and modules of its own; nothing inline, nothing from elsewhere.
constexpr const char* k_policy =
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' data: blob:; "
    "connect-src 'self'; worker-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string random_token() {
    std::random_device random;
    std::string token;
    for (int word = 0; word < 4; ++word) {
        char digits[9];
        std::snprintf(digits, sizeof digits, "%08x", static_cast<unsigned>(random()));
        token += digits;
    }
    return token;
}

/// Takes the same time wherever they differ.
bool same_secret(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned differ = 0;
    for (std::size_t i = 0; i < a.size(); ++i) differ |= static_cast<unsigned char>(a[i] ^ b[i]);
    return differ == 0;
}

const char* content_type(const fs::path& file) {
    constexpr std::array<std::pair<std::string_view, const char*>, 9> types{{{".html", "text/html; charset=utf-8"},
                                                                             {".js", "text/javascript"},
                                                                             {".css", "text/css"},
                                                                             {".wasm", "application/wasm"},
                                                                             {".svg", "image/svg+xml"},
                                                                             {".png", "image/png"},
                                                                             {".json", "application/json"},
                                                                             {".glb", "model/gltf-binary"},
                                                                             {".txt", "text/plain; charset=utf-8"}}};
    const std::string extension = file.extension().string();
    for (const auto& [ending, type] : types)
        if (ending == extension) return type;
    return "application/octet-stream";
}

void refuse(httplib::Response& response, int status, const std::string& text) {
    response.status = status;
    response.set_content(text, "text/plain; charset=utf-8");
}

}  // namespace

struct Server::Parts {
    ProjectFolder app;
    std::optional<ProjectFolder> project;
    std::string token = random_token();
    int port = 0;
    std::mutex writing;  // one save at a time
    httplib::Server http;

    explicit Parts(const ServerOptions& options) : app(options.app) {
        if (options.project) project.emplace(*options.project);
    }

    bool is_ours(const std::string& authority) const {
        const std::string suffix = ":" + std::to_string(port);
        return authority == k_loopback + suffix || authority == "localhost" + suffix;
    }

    /// False, and `response` says why, where a request is none of this run's page.
    bool admit(const httplib::Request& request, httplib::Response& response) const {
        if (!is_ours(request.get_header_value("Host"))) {
            refuse(response, 403, "This server answers to 127.0.0.1 only.");
            return false;
        }
        const std::string origin = request.get_header_value("Origin");
        if (request.has_header("Origin") && !(origin.rfind("http://", 0) == 0 && is_ours(origin.substr(7)))) {
            refuse(response, 403, "This server answers no other page.");
            return false;
        }
        if (request.path.rfind(k_api, 0) == 0 && !same_secret(request.get_header_value("X-Surefoot-Token"), token)) {
            refuse(response, 401, "The address has no token of this run. Open the one that 'surefoot studio' printed.");
            return false;
        }
        return true;
    }

    void give_file(const ProjectFolder& from, const std::string& relative, httplib::Response& response) const {
        const std::optional<fs::path> path = from.inside(relative);
        std::error_code error;
        if (!path || !fs::is_regular_file(*path, error))
            return refuse(response, 404, "There is no file '" + relative + "'.");
        try {
            response.set_content(read_file(*path), content_type(*path));
        } catch (const Error& failure) {
            refuse(response, 500, failure.what());
        }
    }

    void give_listing(httplib::Response& response) const {
        nlohmann::ordered_json out{{"folder", nullptr}, {"files", nlohmann::ordered_json::array()}};
        if (project) {
            out["folder"] = project->folder().filename().string();
            for (const FolderFile& file : project->list())
                out["files"].push_back(
                    {{"path", file.path}, {"bytes", file.bytes}, {"changed", std::to_string(file.changed_ns)}});
        }
        const auto replace = nlohmann::ordered_json::error_handler_t::replace;  // of names that are no UTF-8
        response.set_content(out.dump(-1, ' ', false, replace), "application/json");
    }

    void save(const std::string& relative, const std::string& bytes, httplib::Response& response) {
        const std::optional<fs::path> path = project ? project->inside(relative) : std::nullopt;
        std::error_code error;
        if (!path || fs::is_directory(*path, error))
            return refuse(response, 403, "'" + relative + "' is no file of the project's folder.");
        try {
            const std::lock_guard lock(writing);
            write_file(*path, bytes);
            response.status = 204;
        } catch (const Error& failure) {
            refuse(response, 500, failure.what());
        }
    }

    /// Clips come and go with repairs; all else in the folder is not ours to remove.
    void remove(const std::string& relative, httplib::Response& response) {
        const std::optional<fs::path> path = project ? project->inside(relative) : std::nullopt;
        std::error_code error;
        const bool is_clip = path && path->parent_path() == project->folder() / "clips" && path->extension() == ".glb";
        if (!is_clip || !fs::is_regular_file(*path, error))
            return refuse(response, 403, "'" + relative + "' is no clip of the project's folder.");
        const std::lock_guard lock(writing);
        if (!fs::remove(*path, error)) return refuse(response, 500, "'" + relative + "' could not be removed.");
        response.status = 204;
    }

    void route() {
        http.set_default_headers({{"Cross-Origin-Opener-Policy", "same-origin"},
                                  {"Cross-Origin-Embedder-Policy", "require-corp"},
                                  {"Cross-Origin-Resource-Policy", "same-origin"},
                                  {"Content-Security-Policy", k_policy},
                                  {"X-Content-Type-Options", "nosniff"},
                                  {"Referrer-Policy", "no-referrer"},
                                  {"Cache-Control", "no-cache"}});
        // The library would share the port with whoever asks for it next.
        http.set_socket_options([](socket_t socket) {
            const int yes = 1;
            setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        });
        http.set_payload_max_length(k_most_upload_bytes);
        http.set_keep_alive_timeout(2);
        http.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
            return admit(request, response) ? httplib::Server::HandlerResponse::Unhandled
                                            : httplib::Server::HandlerResponse::Handled;
        });
        http.Get("/api/project", [this](const auto&, auto& response) { give_listing(response); });
        http.Get(std::string(k_files) + "(.*)", [this](const httplib::Request& request, httplib::Response& response) {
            if (!project) return refuse(response, 404, "The studio was started without a project.");
            give_file(*project, request.path.substr(k_files.size()), response);
        });
        http.Put(std::string(k_files) + "(.*)", [this](const httplib::Request& request, httplib::Response& response) {
            save(request.path.substr(k_files.size()), request.body, response);
        });
        http.Delete(std::string(k_files) + "(.*)",
                    [this](const httplib::Request& request, httplib::Response& response) {
                        remove(request.path.substr(k_files.size()), response);
                    });
        http.Get("/.*", [this](const httplib::Request& request, httplib::Response& response) {
            give_file(app, request.path == "/" ? "index.html" : request.path.substr(1), response);
        });
    }
};

Server::Server(const ServerOptions& options) {
    std::error_code error;
    if (!fs::is_regular_file(options.app / "index.html", error))
        throw Error("the studio is not built", options.app.string(), "run 'make studio'");
    parts_ = std::make_unique<Parts>(options);
    parts_->route();
    parts_->port = options.port;
    if (options.port == 0)
        parts_->port = parts_->http.bind_to_any_port(k_loopback);
    else if (!parts_->http.bind_to_port(k_loopback, options.port))
        parts_->port = -1;
    if (parts_->port <= 0)
        throw Error("port " + std::to_string(options.port) + " of 127.0.0.1 cannot be listened on", "--port",
                    "leave --port out for a free one");
}

Server::~Server() = default;

int Server::port() const noexcept { return parts_->port; }
const std::string& Server::token() const noexcept { return parts_->token; }
std::string Server::address() const {
    return std::string("http://") + k_loopback + ":" + std::to_string(parts_->port) + "/#token=" + parts_->token;
}
void Server::run() { parts_->http.listen_after_bind(); }
void Server::stop() { parts_->http.stop(); }

fs::path find_app(const fs::path& program) {
    const fs::path folder = program.parent_path().parent_path();
    std::error_code error;
    for (const fs::path& place : {folder / "studio", folder / "share" / "surefoot" / "studio"})
        if (fs::is_regular_file(place / "index.html", error)) return place;
    throw Error("the studio is not built", (folder / "studio").string(), "run 'make studio' once");
}

}  // namespace surefoot::studio
