#pragma once
// Findings as SARIF 2.1.0 (OASIS standard "Static Analysis Results Interchange Format"), which code hosts and editors
// show beside the file that the findings are about.

#include <surefoot/author/project.h>

#include <span>
#include <string>
#include <string_view>

namespace surefoot {

/// The file that findings are about.
struct SarifSource {
    std::string path;                       ///< of project.json, as the user gave it; relative paths stay relative
    std::string_view text;                  ///< its contents, where clips and spaces are looked up by line
    std::string version;                    ///< of this program
    std::span<const std::string> warnings;  ///< what else the run had to say
};

/// One run: a driver with every lint rule (its page of docs/lint as help) and a result for each finding. Levels are
/// error, warning and note (info). A result points at the line of the space, or of the clip where it is about a clip
/// alone, names both as logical locations, and carries place and fix in its properties. Ends with a newline.
std::string sarif_json(std::span<const Finding> findings, const SarifSource& source);

}  // namespace surefoot
