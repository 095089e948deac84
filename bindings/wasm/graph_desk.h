#pragma once
// A graph for somebody to look into while it plays: its states and trees, their weights, its parameters, what happens.
// What the studio's Graph workspace shows.

#include <surefoot/bake/character.h>
#include <surefoot/course/walk.h>
#include <surefoot/program/evaluate.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::wasm {

class GraphDesk {
  public:
    /// Keeps a reference to the character.
    explicit GraphDesk(const Character& character) : character_(character) {}

    /// Another graph, or the same with other numbers, which then goes on where it was. Throws Error with the path to
    /// the node; then all is as it was.
    void read(std::string_view text);
    /// Parameters, nodes and machines: one JSON object (surefoot.d.mts: GraphFacts).
    std::string describe() const;

    /// Who plays it; another one after a graph of another shape was read.
    const std::shared_ptr<WatchedGraphWalker>& walker() const noexcept { return walker_; }
    /// What its speed and turn are steered by.
    LocomotionRequest asked() const noexcept { return asked_; }
    /// Asks for a parameter's value; an index that is none is ignored.
    void set(int parameter, float value) noexcept;
    /// What plays now, and what has happened since the last call (surefoot.d.mts: GraphLive).
    std::string live();

  private:
    struct Happened {
        double time;  ///< [s] that the walker has gone
        GraphEvent event;
    };
    void watch(float dt, const GraphFrame& frame, const GraphScratch& scratch);
    void begin();

    const Character& character_;
    std::unique_ptr<Pack> pack_;
    std::vector<std::string> warnings_;
    std::shared_ptr<WatchedGraphWalker> walker_;
    int speed_ = -1, turn_ = -1;  ///< parameters
    LocomotionRequest asked_;
    double time_ = 0;
    std::vector<float> weights_;  ///< by node
    std::vector<Happened> happened_;
};

}  // namespace surefoot::wasm
