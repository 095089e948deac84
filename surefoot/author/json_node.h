#pragma once
// Reading JSON with the path of every node at hand, so that a message can say where in the file it was unhappy.

#include <surefoot/base/error.h>

#include <nlohmann/json_fwd.hpp>

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace surefoot {

using Json = nlohmann::ordered_json;

/// The shortest decimal that reads back as the same float: 1.4, not 1.399999976158142.
Json short_number(float value);

/// A node of a file being read. Objects remember which keys were asked for; `finish` reports the others. What is read
/// and is not there, or not of that kind, throws Error with the file and the path.
class JsonNode {
  public:
    /// `json` outlives the node; `warnings` may be null.
    JsonNode(const Json& json, std::string file, std::string path, std::vector<std::string>* warnings)
        : json_(&json), file_(std::move(file)), path_(std::move(path)), warnings_(warnings) {}

    const Json& json() const { return *json_; }
    const std::string& path() const { return path_; }
    std::string where() const { return file_ + ": " + (path_.empty() ? "/" : path_); }
    [[noreturn]] void fail(const std::string& problem, const std::string& remedy = {}) const {
        throw Error(problem, where(), remedy);
    }

    /// Of an object.
    bool has(const char* key);
    JsonNode at(const char* key);
    /// Key and value of every entry.
    std::vector<std::pair<std::string, JsonNode>> entries() const;
    /// Of an array.
    std::vector<JsonNode> items() const;

    std::string text() const;
    bool flag() const;
    double number() const;
    float real() const;  ///< finite
    int integer(int low, int high) const;
    std::vector<float> reals() const;
    std::vector<std::string> texts() const;
    /// What a word stands for; `words` are pairs of a word and its value.
    template <class Words>
    auto word(const Words& words) const {
        const std::string found = text();
        std::string all;
        for (const auto& [word, value] : words) {
            if (word == found) return value;
            all += (all.empty() ? "" : ", ") + std::string(word);
        }
        fail("'" + found + "' is not known here", "one of: " + all);
    }

    /// Keys that nobody asked for.
    std::vector<std::string> unknown() const;
    /// Reports them as warnings.
    void finish() const;

  private:
    void need(bool holds, const char* wanted) const;

    const Json* json_;
    std::string file_, path_;
    std::vector<std::string>* warnings_;
    std::set<std::string> known_;
};

}  // namespace surefoot
