#include <surefoot/author/base64.h>
#include <surefoot/author/page.h>
#include <surefoot/author/report.h>
#include <surefoot/author/report_style.h>

#include <fmt/format.h>

namespace surefoot {
namespace {

std::string hashes(std::span<const EmbeddedText> texts) {
    std::string out;
    for (const EmbeddedText& text : texts) out += fmt::format(" 'sha256-{}'", base64_of_hex(text.sha256));
    return out.empty() ? " 'none'" : out;
}

std::string elements(const char* name, std::span<const EmbeddedText> texts) {
    std::string out;
    for (const EmbeddedText& text : texts) out += fmt::format("<{0}>{1}</{0}>", name, text.text);
    return out;
}

}  // namespace

EmbeddedText page_style() { return {report_style(), report_style_sha256()}; }

std::string html_page(const HtmlPage& page) {
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta "
        "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src{2}; script-src{3}; base-uri "
        "'none'; form-action 'none'\">\n<meta name=\"viewport\" content=\"width=device-width, "
        "initial-scale=1\">\n<title>{0}</title>\n{4}</head><body>\n<main>\n<h1>{0}</h1>\n<p "
        "class=\"lead\">{1}</p>\n{5}</main>\n{6}{7}\n</body></html>\n",
        escape_html(page.title), escape_html(page.lead), hashes(page.styles), hashes(page.scripts),
        elements("style", page.styles), page.main, page.tail, elements("script", page.scripts));
}

}  // namespace surefoot
