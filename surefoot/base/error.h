#pragma once
// The one error type of the authoring library. The runtime library never throws: it validates when things are built and
// returns texts (see rig/skeleton.h `problem`), which the authoring side turns into an Error.

#include <stdexcept>
#include <string>
#include <string_view>

namespace surefoot {

/// An error a user can act on: what went wrong, where, and what to do about it.
///
///     throw Error("the motion block ends after 12 of 300 frames", "walk.bvh:481", "export the clip again");
///
/// `what()` reads "walk.bvh:481: the motion block ends after 12 of 300 frames; export the clip again".
class Error : public std::runtime_error {
  public:
    /// `where` is a file with line or byte, a clip or a joint; `remedy` says what to do. Either may be empty.
    Error(std::string_view problem, std::string_view where, std::string_view remedy);

    const std::string& problem() const noexcept { return problem_; }
    const std::string& where() const noexcept { return where_; }
    const std::string& remedy() const noexcept { return remedy_; }

  private:
    std::string problem_, where_, remedy_;
};

}  // namespace surefoot
