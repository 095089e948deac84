#pragma once
// The studio's server: the built app and one project folder, for this machine's browser only.
//
//   GET  /…                    the app
//   GET  /api/project          {"folder", "files": [{"path", "bytes", "changed"}]}: `changed` is a text that differs
//                              whenever the file does
//   GET  /api/files/PATH       a file of the folder
//   PUT  /api/files/PATH       replaces it in one step (host/files.h), making folders where needed
//   DELETE /api/files/clips/NAME.glb  removes a clip; nothing else can be removed
//
// It listens on 127.0.0.1. A request whose Host is not this server's is refused (DNS that is bent to here), one with an
// Origin that is not (other pages), and under /api/ one without this run's token (other programs and users). Pages come
// isolated (COOP, COEP) and with a content security policy that lets them ask nobody else.

#include "project_folder.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace surefoot::studio {

struct ServerOptions {
    std::filesystem::path app;                     ///< the built app: holds index.html
    std::optional<std::filesystem::path> project;  ///< none: /api/project has no files, nothing can be written
    int port = 0;                                  ///< 0: any that is free
};

inline constexpr std::size_t k_most_upload_bytes = std::size_t{256} << 20;

class Server {
  public:
    /// Throws Error where the app is not built, the folder is none, or the port is taken.
    explicit Server(const ServerOptions& options);
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    int port() const noexcept;
    const std::string& token() const noexcept;  ///< 32 hexadecimal digits, new in each run
    /// What to open in a browser: the token travels behind the #, which browsers send to nobody.
    std::string address() const;

    /// Answers until `stop`, which any thread may call.
    void run();
    void stop();

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// Where the built app lies beside this program: ../studio of a build, ../share/surefoot/studio of an installation.
/// Throws Error where it is in neither.
std::filesystem::path find_app(const std::filesystem::path& program);

}  // namespace surefoot::studio
