#pragma once
// The notes that travel with a clip (LoadedClip::extras), kept true when the clip is edited.

#include <string>

namespace surefoot {

struct ClipEdit {
    /// `posed`: what changed is poses or path, not when anything happens.
    enum class Kind { mirrored, reversed, cut, resampled, retimed, posed };
    Kind kind = Kind::resampled;
    float from = 0;      ///< seconds of the clip as it was where the result begins; cut only
    float rate = 1;      ///< how many times as fast the result plays; retimed only
    float duration = 0;  ///< of the result, seconds
    bool cyclic = false;
    std::string text;  ///< what is added to the provenance: "mirrored"
};

/// `extras` (a JSON object as text, or empty) after the edit: its phase events changed as the clip was, its provenance
/// one line longer, all else as it stood. Text that is no object comes back as it is.
std::string edited_extras(const std::string& extras, const ClipEdit& edit);

}  // namespace surefoot
