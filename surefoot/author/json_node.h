#pragma once
// Reading JSON with the path of every node at hand, so that a message can say where in the file it was unhappy.
// Private to this room and graph_text/: include it in .cpp files and private headers only (it brings in all of
// nlohmann/json).

#include <surefoot/base/error.h>

#include <fast_float/fast_float.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace surefoot {

using Json = nlohmann::ordered_json;

/// The shortest decimal that reads back as the same float: 1.4, not 1.399999976158142.
inline Json short_number(float value) {
    const std::string text = fmt::format("{}", value);
    double shortest = 0;
    fast_float::from_chars(text.data(), text.data() + text.size(), shortest);
    return shortest;
}

/// A node of a file being read. Objects remember which keys were asked for; `finish` reports the others.
class JsonNode {
  public:
    JsonNode(const Json& json, std::string file, std::string path, std::vector<std::string>* warnings)
        : json_(&json), file_(std::move(file)), path_(std::move(path)), warnings_(warnings) {}

    const Json& json() const { return *json_; }
    const std::string& path() const { return path_; }
    std::string where() const { return file_ + ": " + (path_.empty() ? "/" : path_); }
    [[noreturn]] void fail(const std::string& problem, const std::string& remedy = {}) const {
        throw Error(problem, where(), remedy);
    }

    bool has(const char* key) {
        need(json_->is_object(), "an object");
        known_.insert(key);
        const auto found = json_->find(key);
        return found != json_->end() && !found->is_null();
    }
    JsonNode at(const char* key) {
        if (!has(key))
            fail("the key \"" + std::string(key) + "\" is missing", "add it, or run `surefoot author` again");
        return {(*json_)[key], file_, path_ + "/" + key, warnings_};
    }
    std::vector<JsonNode> items() const {
        need(json_->is_array(), "an array");
        std::vector<JsonNode> result;
        for (std::size_t i = 0; i < json_->size(); ++i)
            result.emplace_back((*json_)[i], file_, path_ + "/" + std::to_string(i), warnings_);
        return result;
    }
    /// Key and value of every entry of an object.
    std::vector<std::pair<std::string, JsonNode>> entries() const {
        need(json_->is_object(), "an object");
        std::vector<std::pair<std::string, JsonNode>> result;
        for (const auto& [key, value] : json_->items())
            result.emplace_back(key, JsonNode(value, file_, path_ + "/" + key, warnings_));
        return result;
    }

    std::string text() const {
        need(json_->is_string(), "a text");
        return json_->get<std::string>();
    }
    bool flag() const {
        need(json_->is_boolean(), "true or false");
        return json_->get<bool>();
    }
    double number() const {
        need(json_->is_number(), "a number");
        return json_->get<double>();
    }
    float real() const {
        const double value = number();
        need(std::isfinite(value) && std::fabs(value) <= double{std::numeric_limits<float>::max()},
             "a number of usable size");
        return static_cast<float>(value);
    }
    int integer(int low, int high) const {
        need(json_->is_number_integer(), "a whole number");
        const auto value = json_->get<std::int64_t>();
        if (value < low || value > high)
            fail("the number " + json_->dump() + " is not between " + std::to_string(low) + " and " +
                 std::to_string(high));
        return static_cast<int>(value);
    }
    std::vector<float> reals() const {
        std::vector<float> result;
        for (const JsonNode& item : items()) result.push_back(item.real());
        return result;
    }
    std::vector<std::string> texts() const {
        std::vector<std::string> result;
        for (const JsonNode& item : items()) result.push_back(item.text());
        return result;
    }

    /// Keys that nobody asked for.
    std::vector<std::string> unknown() const {
        std::vector<std::string> result;
        for (const auto& [key, value] : json_->items())
            if (!known_.count(key)) result.push_back(key);
        return result;
    }
    void finish() const {
        if (!warnings_) return;
        for (const std::string& key : unknown())
            warnings_->push_back(where() + ": the key \"" + key + "\" is not known and is ignored");
    }

  private:
    void need(bool holds, const char* wanted) const {
        if (holds) return;
        std::string found = json_->dump(-1, ' ', false, Json::error_handler_t::replace);
        if (found.size() > 40) found = found.substr(0, 40) + "...";
        fail("expected " + std::string(wanted) + ", found " + found);
    }

    const Json* json_;
    std::string file_, path_;
    std::vector<std::string>* warnings_;
    std::set<std::string> known_;
};

}  // namespace surefoot
