#pragma once
// A project for somebody to work on: its blend spaces, what is wrong with them, and what mends it. What the studio's
// Blend space workspace shows. Plain C++ that a native build can run as well.

#include <surefoot/author/repair.h>
#include <surefoot/author/workbench.h>
#include <surefoot/bake/character.h>

#include <map>
#include <string>
#include <vector>

namespace surefoot::wasm {

/// Files by name, relative to the project's folder or to what was dragged in.
using Files = std::map<std::string, std::string>;

class BenchDesk {
  public:
    /// The bundled gaits' clips, as `surefoot author --default`.
    static BenchDesk of_default();
    /// A project that `author` wrote; `on_disk`: these are its files there, as against work that was kept elsewhere.
    /// Throws Error.
    static BenchDesk of_project(const Files& files, bool on_disk = true);
    /// Clips with their sidecars, as `surefoot author`; `name` is the project's. Throws Error where none is usable.
    static BenchDesk of_clips(const Files& files, const std::string& name);

    /// Spaces with their samples and cells, the rules with their thresholds as they are set, findings, placeholders,
    /// repairs, clips that are left out, and what can be undone: one JSON object (surefoot.d.mts: BenchFacts).
    std::string describe() const;
    /// What plays, as the bytes of a pack (pack_file/pack.h). Throws Error where nothing does.
    std::string pack() const;

    // Steps that can be undone. Those that throw Error leave everything as it was.

    /// A rule's threshold, "too-close.distance=6"; empty: all back to what the project said when it was opened.
    void set_threshold(const std::string& text);
    /// Mends a finding by its fix's id, all that can be mended for an empty one. A JSON array: what was tried, and how
    /// it went (surefoot.d.mts: FixAttempt). Where nothing could be done, nothing has changed.
    std::string fix(const std::string& id);
    /// Takes back a repair and those that build on it.
    void take_back(const std::string& repair);
    /// Leaves a clip out of the spaces, or takes it in again.
    void leave_out(const std::string& clip, bool out);

    /// False where there is nothing to undo or to do again.
    bool undo();
    bool redo();

    /// Plays the spaces and measures them; `grid` as in ProbeOptions. What it finds is a finding until the spaces
    /// change.
    void probe(int grid);

    /// What the probe found, for a map in colours (surefoot.d.mts: Heat); [] where nobody probed.
    std::string heat() const;

    /// The project's files, as `author` writes them; all of them, or those that are not as they were opened or saved.
    Files files(bool all) const;
    /// Names of files that were opened or saved and are not part of the project any more.
    std::vector<std::string> gone() const;
    /// It is on disk as it is now.
    void saved();

  private:
    struct Step {
        Workbench bench;
        std::string label;
    };

    explicit BenchDesk(Workbench bench);
    /// Before a change. Changes that follow each other under one label are one step.
    void keep(const std::string& label);
    /// A copy to change: what the probe found will not be true of it.
    Workbench unprobed() const;
    /// To what became of the copy.
    void change(Workbench next, const std::string& label);
    bool move(std::vector<Step>& from, std::vector<Step>& to);

    Workbench bench_;
    LintSettings given_;  ///< the project's own, when it was opened
    Workbench saved_;     ///< as it is on disk; no clips where it is nowhere
    std::vector<Step> past_, future_;
    std::vector<std::string> failed_, warnings_;
};

}  // namespace surefoot::wasm
