// One frame of the hero in several libraries: us_per_character is the figure to compare. Before anything is timed, each
// library's pose is held against ours: one clip alone must agree (single_clip_mm), a mix of three differs as far as
// their rules of mixing rotations do (mixed_mm).
//
//   bench_peers                       those libraries that the build found
//   bench_peers --write-hero FILE     the hero as JSON, with poses to agree with, for libraries of other languages

#include <benchmark/benchmark.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "peer.h"

namespace surefoot::bench {
namespace {

const PeerHero& hero() {
    static const PeerHero made = PeerHero::make();
    return made;
}

std::vector<Moment> single_clips() { return {{0.31f, {1, 0, 0}}, {0.777f, {0, 1, 0}}, {0.05f, {0, 0, 1}}}; }
std::vector<Moment> mixes() { return {{0.123f, {0.5f, 0.3f, 0.2f}}, moment(3, 40), moment(8, 90)}; }

std::vector<Matrix34> pose_of(Peer& peer, const Moment& at) {
    std::vector<Matrix34> matrices(hero().joints());
    peer.pose(at, matrices);
    return matrices;
}

/// The most that a joint's place differs from ours [mm].
double worst_mm(Peer& peer, std::span<const Moment> moments) {
    const auto ours = make_surefoot_peer(hero(), 1);
    double worst = 0;
    for (const Moment& at : moments) {
        const auto theirs = pose_of(peer, at), mine = pose_of(*ours, at);
        for (std::size_t j = 0; j < mine.size(); ++j) {
            const Vec3 apart{theirs[j].m[3] - mine[j].m[3], theirs[j].m[7] - mine[j].m[7],
                             theirs[j].m[11] - mine[j].m[11]};
            worst = std::max(worst, 1000.0 * static_cast<double>(length(apart)));
        }
    }
    return worst;
}

/// Crowds are made once, however often a benchmark is repeated; they go before the libraries' own statics do.
using Crowds = std::map<std::pair<MakePeer, std::size_t>, std::unique_ptr<Peer>>;

void frame(benchmark::State& state, Crowds& crowds, MakePeer make) {
    const auto characters = static_cast<std::size_t>(state.range(0));
    auto& made = crowds[{make, characters}];
    if (!made) made = make(hero(), characters);
    Peer& peer = *made;
    const double alone = worst_mm(peer, single_clips());
    if (!(alone < 1)) return state.SkipWithError("its pose of one clip differs from ours by more than 1 mm");
    state.counters["single_clip_mm"] = alone;
    state.counters["mixed_mm"] = worst_mm(peer, mixes());
    std::vector<Matrix34> matrices(characters * hero().joints());
    int at = 0;
    for (auto _ : state) {
        peer.play(++at, matrices);
        benchmark::ClobberMemory();
    }
    state.counters["us_per_character"] =
        benchmark::Counter(static_cast<double>(characters) * 1e-6,
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void add(const char* name, Crowds& crowds, MakePeer make) {
    benchmark::RegisterBenchmark(name, frame, std::ref(crowds), make)
        ->ArgName("characters")
        ->Arg(100)
        ->Arg(10000)
        ->Unit(benchmark::kMillisecond);
}

nlohmann::json numbers(Vec3 v) { return {v.x, v.y, v.z}; }
nlohmann::json numbers(Quat q) { return {q.x, q.y, q.z, q.w}; }

nlohmann::json poses(std::span<const Moment> moments) {
    const auto ours = make_surefoot_peer(hero(), 1);
    nlohmann::json list;
    for (const Moment& at : moments) {
        nlohmann::json places;
        for (const Matrix34& m : pose_of(*ours, at)) places.push_back({m.m[3], m.m[7], m.m[11]});
        list.push_back({{"seconds", at.seconds}, {"weights", at.weights}, {"places", places}});
    }
    return list;
}

int write_hero(const char* file) {
    nlohmann::json json{{"single_clips", poses(single_clips())}, {"mixes", poses(mixes())}};
    for (std::size_t j = 0; j < hero().joints(); ++j)
        json["joints"].push_back({{"name", hero().skeleton->names[j]},
                                  {"parent", hero().skeleton->parents[j]},
                                  {"translation", numbers(hero().skeleton->rest[j].translation)},
                                  {"rotation", numbers(hero().skeleton->rest[j].rotation)}});
    for (int f = 0; f < hero().frames(); ++f) json["times"].push_back(hero().seconds(f));
    for (std::size_t c = 0; c < k_mixed; ++c) {
        nlohmann::json clip;
        for (int f = 0; f < hero().frames(); ++f) {
            clip["translations"].push_back(numbers(hero().translation(c, f, 0)));
            for (std::size_t j = 0; j < hero().joints(); ++j)
                clip["rotations"][j].push_back(numbers(hero().rotation(c, f, j)));
        }
        json["clips"].push_back(clip);
    }
    std::ofstream out(file);
    out << json;
    return out.flush() ? 0 : 1;
}

}  // namespace
}  // namespace surefoot::bench

int main(int argc, char** argv) {
    using namespace surefoot::bench;
    if (argc == 3 && std::string(argv[1]) == "--write-hero") return write_hero(argv[2]);
    Crowds crowds;
    add("surefoot", crowds, make_surefoot_peer);
#ifdef SUREFOOT_BENCH_OGRE
    add("ogre", crowds, make_ogre_peer);
#endif
#ifdef SUREFOOT_BENCH_CAL3D
    add("cal3d", crowds, make_cal3d_peer);
#endif
#ifdef SUREFOOT_BENCH_OSG
    add("osgAnimation", crowds, make_osg_peer);
#endif
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
