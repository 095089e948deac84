// Each gate on our own tree, and on trees that it must not let through: a gate that checks nothing is worse than none.

#include "source_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace surefoot::gates {
namespace {

const std::filesystem::path k_ours = SUREFOOT_SOURCE_DIR;

std::filesystem::path bad_tree(const std::string& name) { return k_ours / "tests/gates/bad_trees" / name; }

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

bool mentions(const std::vector<std::string>& lines, const std::string& text) {
    return std::any_of(lines.begin(), lines.end(), [&](const auto& line) { return line.find(text) != line.npos; });
}

#define EXPECT_MENTIONS(lines, text) EXPECT_TRUE(mentions(lines, text)) << joined(lines)

std::vector<std::string> undefined_libm(const std::string& library) {
    const CommandResult result = run(std::string("'") + SUREFOOT_NM + "' -u '" + library + "' 2>/dev/null");
    EXPECT_EQ(result.status, 0) << "nm could not read " << library;
    EXPECT_FALSE(result.output.empty()) << "nm saw nothing in " << library;
    return libm_symbols(result.output);
}

std::vector<std::string> split(const std::string& list) {
    std::vector<std::string> parts;
    for (std::size_t at = 0; at < list.size();) {
        const std::size_t end = std::min(list.find('|', at), list.size());
        if (end > at) parts.push_back(list.substr(at, end - at));
        at = end + 1;
    }
    return parts;
}

/// Weak symbols that more than one of the objects defines: the linker keeps one, built for who knows which processor.
std::vector<std::string> shared_weak_symbols(const std::vector<std::string>& objects) {
    std::map<std::string, int> seen;
    for (const std::string& object : objects) {
        const CommandResult result = run(std::string("'") + SUREFOOT_NM + "' '" + object + "' 2>/dev/null");
        EXPECT_EQ(result.status, 0) << "nm could not read " << object;
        std::istringstream lines(result.output);
        for (std::string line; std::getline(lines, line);) {
            std::istringstream words(line);
            std::string address, kind, name;
            words >> address >> kind >> name;
            if (kind == "W" || kind == "V" || kind == "u") ++seen[name];
        }
    }
    std::vector<std::string> shared;
    for (const auto& [name, count] : seen)
        if (count > 1) shared.push_back(name);
    return shared;
}

}  // namespace

TEST(KernelGate, kernels_for_different_processors_share_no_inline_function) {
    const auto objects = split(SUREFOOT_KERNEL_OBJECTS);
    ASSERT_GE(objects.size(), 1u);
    EXPECT_EQ(joined(shared_weak_symbols(objects)), "");
}

TEST(KernelGate, sees_an_inline_function_that_two_objects_share) {
    EXPECT_MENTIONS(shared_weak_symbols(split(SUREFOOT_SHARED_INLINE_OBJECTS)), "gate_shared_inline");
}

TEST(LayeringGate, our_rooms_lean_only_on_rooms_above_them) {
    EXPECT_GE(rooms_of(k_ours).size(), 10u);
    EXPECT_EQ(joined(layering_breaches(k_ours)), "");
}

TEST(LayeringGate, rooms_are_read_as_declared) {
    const std::vector<Room> rooms = rooms_of(bad_tree("upward"));
    ASSERT_EQ(rooms.size(), 4u);
    EXPECT_EQ(rooms[2].name, "rig");
    EXPECT_TRUE(rooms[2].runtime);
    EXPECT_EQ(rooms[3].depends, std::vector<std::string>{"rig"});
    EXPECT_FALSE(rooms[3].runtime);
}

TEST(LayeringGate, stops_an_include_of_a_room_below) {
    const auto breaches = layering_breaches(bad_tree("upward"));
    EXPECT_EQ(joined(breaches), "surefoot/math/quat.h:3: room 'math' includes 'rig' from below it\n");
}

TEST(LayeringGate, stops_an_authoring_include_in_a_runtime_room) {
    const auto breaches = layering_breaches(bad_tree("authoring"));
    EXPECT_MENTIONS(breaches, "surefoot/rig/pose.h:2: runtime room 'rig' includes authoring room 'motion'");
}

TEST(LayeringGate, stops_third_party_and_streams_in_a_runtime_room_and_third_party_behind_public_headers) {
    const auto breaches = layering_breaches(bad_tree("third_party"));
    EXPECT_MENTIONS(breaches, "pose.cpp:2: a runtime room may not include <Eigen/Core>");
    EXPECT_MENTIONS(breaches, "pose.cpp:3: a runtime room may not include <fstream>");
    EXPECT_MENTIONS(breaches, "pose.cpp:4: a runtime room may not include <thread>");
    EXPECT_MENTIONS(breaches, "edit.h:1: takes <nlohmann/json.hpp> from surefoot/motion/clip.h");
    EXPECT_MENTIONS(breaches, "pose.cpp:5: intrinsics belong into surefoot/math/lanes*");
    EXPECT_EQ(breaches.size(), 5u) << joined(breaches);
}

TEST(LayeringGate, stops_a_cycle_of_includes) {
    EXPECT_MENTIONS(layering_breaches(bad_tree("cycle")),
                    "include cycle: surefoot/rig/a.h -> surefoot/rig/b.h -> surefoot/rig/a.h");
}

TEST(LayeringGate, stops_ways_around_it) {
    const auto breaches = layering_breaches(bad_tree("escape"));
    EXPECT_MENTIONS(breaches, "quat.h:2: \"../rig/pose.h\" leaves its room");
    EXPECT_MENTIONS(breaches, "quat.h:4: an include through a macro");
    EXPECT_MENTIONS(breaches, "quat.h:5: no such file: surefoot/rig/missing.h");
    EXPECT_MENTIONS(breaches, "attic/old.h:1: lies in no room");
    EXPECT_MENTIONS(breaches, "quat.h:1: has no #pragma once");
    EXPECT_EQ(breaches.size(), 5u) << joined(breaches);
}

TEST(TypesGate, our_types_are_defined_once) { EXPECT_EQ(joined(doubled_types(k_ours)), ""); }

TEST(TypesGate, sees_types_that_two_files_define) {
    const auto doubled = doubled_types(bad_tree("types"));
    EXPECT_EQ(doubled.size(), 2u) << joined(doubled);
    EXPECT_MENTIONS(doubled, "surefoot/rig/plan.cpp:4: surefoot::Source is defined at surefoot/math/bake.h:6, too");
    EXPECT_MENTIONS(doubled, "surefoot::Stairs");
}

TEST(LibmGate, our_sources_call_no_transcendental_of_libm) { EXPECT_EQ(joined(libm_calls(k_ours)), ""); }

TEST(LibmGate, stops_every_way_of_calling_one) {
    const auto calls = libm_calls(bad_tree("libm"));
    for (const char* line :
         {"curve.cpp:6:", "curve.cpp:7:", "curve.cpp:8:", "curve.cpp:9:", "curve.cpp:10:", "curve.cpp:11:"})
        EXPECT_MENTIONS(calls, line);
    EXPECT_EQ(calls.size(), 6u) << joined(calls);
}

TEST(LibmGate, our_runtime_libraries_ask_libm_for_none) {
    const auto libraries = split(SUREFOOT_RUNTIME_LIBRARIES);
    EXPECT_GE(libraries.size(), 3u);
    for (const std::string& library : libraries) EXPECT_EQ(joined(undefined_libm(library)), "") << library;
}

TEST(LibmGate, sees_what_a_library_asks_libm_for) {
    EXPECT_EQ(undefined_libm(SUREFOOT_LIBM_USER), (std::vector<std::string>{"powf", "sin"}));
}

TEST(HeaderGate, every_header_of_ours_compiles_alone) {
    EXPECT_EQ(joined(dependent_headers(k_ours, SUREFOOT_COMPILER, SUREFOOT_SCRATCH "/ours")), "");
}

TEST(HeaderGate, stops_a_header_that_needs_another_one_first) {
    EXPECT_MENTIONS(dependent_headers(bad_tree("header"), SUREFOOT_COMPILER, SUREFOOT_SCRATCH "/bad"), "alone.h");
}

}  // namespace surefoot::gates
