#include <surefoot/author/json_node.h>

#include <fast_float/fast_float.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace surefoot {

Json short_number(float value) {
    const std::string text = fmt::format("{}", value);
    double shortest = 0;
    fast_float::from_chars(text.data(), text.data() + text.size(), shortest);
    return shortest;
}

bool JsonNode::has(const char* key) {
    need(json_->is_object(), "an object");
    known_.insert(key);
    const auto found = json_->find(key);
    return found != json_->end() && !found->is_null();
}

JsonNode JsonNode::at(const char* key) {
    if (!has(key)) fail("the key \"" + std::string(key) + "\" is missing", "add it, or run `surefoot author` again");
    return {(*json_)[key], file_, path_ + "/" + key, warnings_};
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::entries() const {
    need(json_->is_object(), "an object");
    std::vector<std::pair<std::string, JsonNode>> result;
    for (const auto& [key, value] : json_->items())
        result.emplace_back(key, JsonNode(value, file_, path_ + "/" + key, warnings_));
    return result;
}

std::vector<JsonNode> JsonNode::items() const {
    need(json_->is_array(), "an array");
    std::vector<JsonNode> result;
    for (std::size_t i = 0; i < json_->size(); ++i)
        result.emplace_back((*json_)[i], file_, path_ + "/" + std::to_string(i), warnings_);
    return result;
}

std::string JsonNode::text() const {
    need(json_->is_string(), "a text");
    return json_->get<std::string>();
}

bool JsonNode::flag() const {
    need(json_->is_boolean(), "true or false");
    return json_->get<bool>();
}

double JsonNode::number() const {
    need(json_->is_number(), "a number");
    return json_->get<double>();
}

float JsonNode::real() const {
    const double value = number();
    need(std::isfinite(value) && std::fabs(value) <= double{std::numeric_limits<float>::max()},
         "a number of usable size");
    return static_cast<float>(value);
}

int JsonNode::integer(int low, int high) const {
    need(json_->is_number_integer(), "a whole number");
    const auto value = json_->get<std::int64_t>();
    if (value < low || value > high)
        fail("the number " + json_->dump() + " is not between " + std::to_string(low) + " and " + std::to_string(high));
    return static_cast<int>(value);
}

std::vector<float> JsonNode::reals() const {
    std::vector<float> result;
    for (const JsonNode& item : items()) result.push_back(item.real());
    return result;
}

std::vector<std::string> JsonNode::texts() const {
    std::vector<std::string> result;
    for (const JsonNode& item : items()) result.push_back(item.text());
    return result;
}

std::vector<std::string> JsonNode::unknown() const {
    std::vector<std::string> result;
    for (const auto& [key, value] : json_->items())
        if (!known_.count(key)) result.push_back(key);
    return result;
}

void JsonNode::finish() const {
    if (!warnings_) return;
    for (const std::string& key : unknown())
        warnings_->push_back(where() + ": the key \"" + key + "\" is not known and is ignored");
}

void JsonNode::need(bool holds, const char* wanted) const {
    if (holds) return;
    std::string found = json_->dump(-1, ' ', false, Json::error_handler_t::replace);
    if (found.size() > 40) found = found.substr(0, 40) + "...";
    fail("expected " + std::string(wanted) + ", found " + found);
}

}  // namespace surefoot
