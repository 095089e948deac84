// The studio's server as a hostile page or program would try it.

#include <server/server.h>

#include <surefoot/base/error.h>
#include <surefoot/host/files.h>

#include <tests/support/folder.h>

#include <gtest/gtest.h>
#include <httplib.h>
#include <nlohmann/json.hpp>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <thread>

namespace surefoot::studio {
namespace {

namespace fs = std::filesystem;

/// A server on a folder with an app, a project, and something beside it that is nobody's business.
class StudioServer : public ::testing::Test {
  protected:
    StudioServer() {
        write_file(root() / "app/index.html", "<!doctype html>app");
        write_file(root() / "app/assets/engine.wasm", "engine");
        write_file(root() / "project/project.json", "{}");
        write_file(root() / "project/clips/walk.glb", "walk");
        write_file(root() / "project/.cache/kept", "kept");
        write_file(root() / "secret.txt", "secret");
        fs::create_symlink(root() / "secret.txt", root() / "project/way_out.txt");
        fs::create_directory_symlink(root(), root() / "project/up");
        fs::create_symlink(root() / "not_there_yet.txt", root() / "project/dangling.txt");
        fs::create_symlink("clips/walk.glb", root() / "project/same_walk.glb");
        server_ = std::make_unique<Server>(ServerOptions{root() / "app", root() / "project", 0});
        thread_ = std::thread([this] { server_->run(); });
        client_ = std::make_unique<httplib::Client>("127.0.0.1", server_->port());
    }
    ~StudioServer() override {
        server_->stop();
        thread_.join();
    }

    fs::path root() const { return folder_.path; }
    httplib::Headers token() const { return {{"X-Surefoot-Token", server_->token()}}; }
    std::string host() const { return "127.0.0.1:" + std::to_string(server_->port()); }
    int get(const std::string& path, httplib::Headers headers) {
        const auto answer = client_->Get(path, headers);
        return answer ? answer->status : -1;
    }
    int put(const std::string& path, const std::string& bytes, httplib::Headers headers) {
        const auto answer = client_->Put(path, headers, bytes, "application/octet-stream");
        return answer ? answer->status : -1;
    }
    /// A request line as it stands, which no client would send; returns the status.
    int raw(const std::string& request_line, const std::string& headers = {}) {
        const int to = socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(server_->port()));
        inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
        if (connect(to, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) return -1;
        const std::string request =
            request_line + " HTTP/1.1\r\nHost: " + host() + "\r\n" + headers + "Connection: close\r\n\r\n";
        EXPECT_EQ(write(to, request.data(), request.size()), static_cast<ssize_t>(request.size()));
        std::string answer(64, '\0');
        const ssize_t size = read(to, answer.data(), answer.size());
        close(to);
        return size > 12 ? std::atoi(answer.c_str() + 9) : -1;
    }

    test::Folder folder_;
    std::unique_ptr<Server> server_;
    std::unique_ptr<httplib::Client> client_;
    std::thread thread_;
};

TEST_F(StudioServer, gives_the_app_isolated_and_with_a_policy) {
    const auto answer = client_->Get("/");
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 200);
    EXPECT_EQ(answer->body, "<!doctype html>app");
    EXPECT_EQ(answer->get_header_value("Cross-Origin-Opener-Policy"), "same-origin");
    EXPECT_EQ(answer->get_header_value("Cross-Origin-Embedder-Policy"), "require-corp");
    EXPECT_NE(answer->get_header_value("Content-Security-Policy").find("default-src 'none'"), std::string::npos);
    const auto engine = client_->Get("/assets/engine.wasm");
    ASSERT_TRUE(engine);
    EXPECT_EQ(engine->get_header_value("Content-Type"), "application/wasm");
    EXPECT_EQ(get("/nothing.js", {}), 404);
}

TEST_F(StudioServer, lists_the_project_without_what_is_hidden_or_leads_out) {
    const auto answer = client_->Get("/api/project", token());
    ASSERT_TRUE(answer);
    const auto listing = nlohmann::json::parse(answer->body);
    EXPECT_EQ(listing["folder"], "project");
    std::vector<std::string> files;
    for (const auto& file : listing["files"]) files.push_back(file["path"]);
    EXPECT_EQ(files, (std::vector<std::string>{"clips/walk.glb", "project.json", "same_walk.glb"}));
}

TEST_F(StudioServer, reads_and_writes_files_of_the_project) {
    const auto answer = client_->Get("/api/files/clips/walk.glb", token());
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->body, "walk");
    EXPECT_EQ(put("/api/files/project.json", "{\"version\": 1}", token()), 204);
    EXPECT_EQ(read_file(root() / "project/project.json"), "{\"version\": 1}");
    EXPECT_EQ(put("/api/files/new%20folder/clip%20%C3%A4.glb", "new", token()), 204);
    EXPECT_EQ(read_file(root() / "project/new folder/clip \xC3\xA4.glb"), "new");
    EXPECT_EQ(put("/api/files/clips", "no folder becomes a file", token()), 403);
}

TEST_F(StudioServer, removes_clips_of_the_project_and_nothing_else) {
    const auto remove = [&](const std::string& path) {
        httplib::Client client("127.0.0.1", server_->port());
        return client.Delete(path, token())->status;
    };
    ASSERT_EQ(put("/api/files/clips/gone.glb", "new", token()), 204);
    EXPECT_EQ(remove("/api/files/clips/gone.glb"), 204);
    EXPECT_FALSE(fs::exists(root() / "project/clips/gone.glb"));
    EXPECT_EQ(remove("/api/files/clips/gone.glb"), 403);
    EXPECT_EQ(remove("/api/files/project.json"), 403);
    EXPECT_EQ(remove("/api/files/clips"), 403);
    ASSERT_EQ(put("/api/files/notes.glb", "mine", token()), 204);
    EXPECT_EQ(remove("/api/files/notes.glb"), 403);
    EXPECT_EQ(read_file(root() / "project/notes.glb"), "mine");
}

TEST_F(StudioServer, says_when_a_file_has_changed) {
    const auto changed = [&] {
        return nlohmann::json::parse(client_->Get("/api/project", token())->body)["files"][1]["changed"]
            .get<std::string>();
    };
    const std::string before = changed();
    EXPECT_EQ(changed(), before);
    EXPECT_EQ(put("/api/files/project.json", "{\"changed\": 1}", token()), 204);
    EXPECT_NE(changed(), before);
}

TEST_F(StudioServer, refuses_whoever_has_not_this_runs_token) {
    EXPECT_EQ(get("/api/project", {}), 401);
    EXPECT_EQ(get("/api/project", {{"X-Surefoot-Token", ""}}), 401);
    std::string wrong = server_->token();
    wrong.back() = wrong.back() == '0' ? '1' : '0';
    EXPECT_EQ(get("/api/project", {{"X-Surefoot-Token", wrong}}), 401);
    EXPECT_EQ(get("/api/files/project.json", {}), 401);
    EXPECT_EQ(put("/api/files/project.json", "stolen", {}), 401);
    EXPECT_EQ(get("/api/files/project.json?X-Surefoot-Token=" + server_->token(), {}), 401);
    EXPECT_EQ(raw("GET /%61pi/project"), 401) << "an encoded letter is the same path";
    EXPECT_EQ(read_file(root() / "project/project.json"), "{}");
    EXPECT_EQ(server_->token().size(), 32u);
    const Server other({root() / "app", root() / "project", 0});
    EXPECT_NE(other.token(), server_->token());
}

TEST_F(StudioServer, refuses_other_hosts_and_other_pages) {
    auto with = [&](const char* header, const std::string& value) {
        httplib::Headers headers = token();
        headers.emplace(header, value);
        return headers;
    };
    const std::string port = std::to_string(server_->port());
    EXPECT_EQ(get("/", {{"Host", "evil.example"}}), 403);
    EXPECT_EQ(get("/api/project", with("Host", "evil.example:" + port)), 403);
    EXPECT_EQ(get("/api/project", with("Host", "127.0.0.1:1")), 403);
    EXPECT_EQ(get("/api/project", with("Host", "127.0.0.1:" + port + ".evil.example")), 403);
    EXPECT_EQ(get("/api/project", with("Host", "localhost:" + port)), 200);
    EXPECT_EQ(get("/api/project", with("Origin", "http://evil.example")), 403);
    EXPECT_EQ(get("/api/project", with("Origin", "https://127.0.0.1:" + port)), 403);
    EXPECT_EQ(get("/api/project", with("Origin", "null")), 403);
    EXPECT_EQ(get("/api/project", with("Origin", "http://127.0.0.1:" + port)), 200);
    EXPECT_EQ(put("/api/files/project.json", "stolen", with("Origin", "http://evil.example")), 403);
    EXPECT_EQ(read_file(root() / "project/project.json"), "{}");
}

TEST_F(StudioServer, nothing_outside_of_the_folder_is_read_or_written) {
    const std::string key = "X-Surefoot-Token: " + server_->token() + "\r\n";
    const std::string ways[] = {"../secret.txt",
                                "clips/../../secret.txt",
                                "clips/..",
                                "%2e%2e/secret.txt",
                                "%2e%2e%2fsecret.txt",
                                ".%2e/secret.txt",
                                "..%5csecret.txt",
                                "/etc/passwd",
                                "%2fetc%2fpasswd",
                                "//etc/passwd",
                                "./project.json",
                                "way_out.txt",
                                "up/secret.txt",
                                "up/project/project.json/../../secret.txt",
                                "dangling.txt",
                                ".cache/kept",
                                "project.json%00.txt",
                                "c:secret.txt",
                                "",
                                "clips//walk.glb"};
    for (const std::string& way : ways) {
        EXPECT_NE(raw("GET /api/files/" + way, key), 200) << way;
        const int status = raw("PUT /api/files/" + way, key + "Content-Length: 0\r\n");
        EXPECT_NE(status, 200) << way;
        EXPECT_NE(status, 204) << way;
        EXPECT_NE(raw("DELETE /api/files/" + way, key), 204) << way;
    }
    for (const std::string way : {"/../secret.txt", "/%2e%2e/secret.txt", "/assets/../../secret.txt"})
        EXPECT_NE(raw("GET " + way), 200) << way;
    EXPECT_EQ(read_file(root() / "secret.txt"), "secret");
    EXPECT_FALSE(fs::exists(root() / "not_there_yet.txt"));
    EXPECT_EQ(put("/api/files/%252e%252e/odd.txt", "odd", token()), 204) << "decoded once, this is a name like others";
    EXPECT_EQ(read_file(root() / "project/%2e%2e/odd.txt"), "odd");
    EXPECT_EQ(get("/api/files/same_walk.glb", token()), 200) << "a link that stays inside is fine";
}

TEST_F(StudioServer, a_failed_save_leaves_what_was_there) {
    EXPECT_GE(put("/api/files/project.json/below.glb", "new", token()), 400) << "a file is no folder";
    EXPECT_GE(put("/api/files/clips/" + std::string(300, 'x'), "new", token()), 400) << "too long for a file's name";
    if (geteuid() != 0) {  // nobody keeps root from writing
        fs::permissions(root() / "project", fs::perms::owner_read | fs::perms::owner_exec);
        EXPECT_EQ(put("/api/files/project.json", "half", token()), 500);
        fs::permissions(root() / "project", fs::perms::owner_all);
    }
    EXPECT_EQ(read_file(root() / "project/project.json"), "{}");
    for (const auto& entry : fs::recursive_directory_iterator(root() / "project"))
        EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << entry.path();
}

TEST_F(StudioServer, who_reads_while_another_saves_sees_one_state_or_the_other) {
    const std::string one(200000, '1'), two(300000, '2');
    ASSERT_EQ(put("/api/files/project.json", one, token()), 204);
    std::atomic<bool> done = false;
    std::thread writer([&] {
        httplib::Client client("127.0.0.1", server_->port());
        for (int i = 0; i < 40; ++i)
            client.Put("/api/files/project.json", token(), i % 2 ? one : two, "application/json");
        done = true;
    });
    int reads = 0;
    while (!done || reads < 5) {
        const std::string now = read_file(root() / "project/project.json");
        EXPECT_TRUE(now == one || now == two) << now.size();
        ++reads;
    }
    writer.join();
}

TEST_F(StudioServer, odd_requests_do_no_harm) {
    EXPECT_GE(raw("GET /" + std::string(8000, 'a')), 400);
    EXPECT_GE(raw("GET /" + std::string(100000, 'a')), 400);
    EXPECT_GE(raw("GET /api/files/" + std::string(4000, '/'), "X-Surefoot-Token: " + server_->token() + "\r\n"), 400);
    EXPECT_GE(raw("DELETE /api/files/project.json", "X-Surefoot-Token: " + server_->token() + "\r\n"), 400);
    EXPECT_GE(
        raw("POST /api/files/project.json", "X-Surefoot-Token: " + server_->token() + "\r\nContent-Length: 0\r\n"),
        400);
    EXPECT_EQ(get("/api/project", token()), 200);
}

TEST(StudioServerStart, says_what_is_missing) {
    const test::Folder folder;
    const auto message = [](const auto& call) -> std::string {
        try {
            call();
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    };
    EXPECT_NE(message([&] { Server({folder.path, {}, 0}); }).find("make studio"), std::string::npos);
    EXPECT_NE(message([&] { find_app(folder.path / "bin/surefoot"); }).find("make studio"), std::string::npos);
    write_file(folder.path / "app/index.html", "app");
    EXPECT_NE(message([&] {
                  Server({folder.path / "app", folder.path / "nowhere", 0});
              }).find("nowhere"),
              std::string::npos);
    const Server first({folder.path / "app", {}, 0});
    EXPECT_NE(message([&] { Server({folder.path / "app", {}, first.port()}); }).find("--port"), std::string::npos);
    write_file(folder.path / "share/surefoot/studio/index.html", "app");
    EXPECT_EQ(find_app(folder.path / "bin/surefoot"), folder.path / "share/surefoot/studio");
}

}  // namespace
}  // namespace surefoot::studio
