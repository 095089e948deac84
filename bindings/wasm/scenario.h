#pragma once
// Long scenarios through the library, each reduced to a hash. A native build and the WebAssembly module must give the
// same text: that is what "bit-exact everywhere" means (docs/architecture.md).

#include <string>

namespace surefoot::wasm {

/// One line a scenario: its name, a blank, 16 hexadecimal digits.
std::string run_scenarios();

/// The generated walk as BVH text, for whoever needs a clip.
std::string example_bvh();

}  // namespace surefoot::wasm
