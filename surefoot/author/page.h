#pragma once
// The frame of an HTML page that opens from disk without a network: for the report, and for pages of other rooms.

#include <span>
#include <string>
#include <vector>

namespace surefoot {

/// A text that travels inside the program (cmake/SurefootEmbed.cmake), with its hash in hexadecimal.
struct EmbeddedText {
    const char* text;
    const char* sha256;
};

/// Colours, type and tables of every page, light, dark and on paper.
EmbeddedText page_style();

struct HtmlPage {
    std::string title, lead;  ///< plain text
    std::string main;         ///< HTML under them
    std::string tail;         ///< HTML after it: data for scripts
    std::vector<EmbeddedText> styles, scripts;
};

/// The page. It refers to no other file, and its content security policy lets nothing run but its own scripts and style
/// sheets. Inline styles do not work.
std::string html_page(const HtmlPage& page);

}  // namespace surefoot
