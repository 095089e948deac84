#pragma once
// Changes one value of a JSON text and leaves every other byte as it is: a file that people keep under version control
// then differs in that line alone.

#include <string>
#include <string_view>

namespace surefoot {

/// `text` with `value` (JSON, too) at `pointer` (RFC 6901). A key that its object does not have yet becomes the last
/// one, laid out as the one before it; so does a value at "-" of an array. Throws Error where the text or the value is
/// no JSON, or the place's parent is not there.
std::string with_json_value(std::string_view text, std::string_view pointer, std::string_view value);

/// `text` without what is at `pointer`: a key and its value, or a value of an array, with the comma and the space that
/// went with it. Throws Error where there is nothing, and for the whole text.
std::string without_json_value(std::string_view text, std::string_view pointer);

}  // namespace surefoot
