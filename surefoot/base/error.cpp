#include <surefoot/base/error.h>

namespace surefoot {

namespace {
std::string compose(std::string_view problem, std::string_view where, std::string_view remedy) {
    std::string text;
    if (!where.empty()) text.append(where).append(": ");
    text.append(problem);
    if (!remedy.empty()) text.append("; ").append(remedy);
    return text;
}
}  // namespace

Error::Error(std::string_view problem, std::string_view where, std::string_view remedy)
    : std::runtime_error(compose(problem, where, remedy)), problem_(problem), where_(where), remedy_(remedy) {}

}  // namespace surefoot
