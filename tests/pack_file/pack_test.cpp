#include <surefoot/pack_file/format.h>

#include "tests/pack_file/support.h"
#include "tests/support/allocations.h"

namespace surefoot {
namespace {

using test::Played;

Pack opened(std::span<const std::byte> bytes) {
    std::string why;
    std::optional<Pack> pack = Pack::open(bytes, &why);
    EXPECT_TRUE(pack) << why;
    return pack ? *std::move(pack) : Pack();
}

/// One for all tests: authoring takes a moment.
const Pack& whole() {
    static const Pack pack = test::whole_pack();
    return pack;
}
const std::vector<std::byte>& whole_bytes() {
    static const std::vector<std::byte> bytes = pack_bytes(whole());
    return bytes;
}

TEST(Pack, a_graph_plays_the_same_bits_from_its_pack) {
    const Pack pack = opened(whole_bytes());
    EXPECT_EQ(problem(pack), "");
    EXPECT_TRUE(Played(pack, 900) == Played(whole(), 900));
}

TEST(Pack, a_project_plays_the_same_bits_from_its_pack) {
    const Pack source = test::body_of(whole());
    const std::vector<std::byte> bytes = pack_bytes(source);
    const Pack pack = opened(bytes);
    EXPECT_FALSE(pack.has_program());
    EXPECT_EQ(pack.program.name, "whole");
    EXPECT_TRUE(Played(pack, 600) == Played(source, 600));
}

// What SUREFOOT_FIELDS lists is all there is, or it does not compile; what it stores is told by the bytes; what is made
// again is compared here.
TEST(Pack, what_is_not_stored_is_made_again) {
    const Pack pack = opened(whole_bytes());
    EXPECT_EQ(pack_bytes(pack), whole_bytes());
    const LocomotionGraph &body = pack.graph(), &source = whole().graph();
    const auto same_space = [](const LocomotionSpace& a, const LocomotionSpace& b) {
        EXPECT_EQ(a.velocities, b.velocities);
        EXPECT_EQ(a.turns, b.turns);
        EXPECT_EQ(a.axes, b.axes);
        EXPECT_EQ(a.custom_slots, b.custom_slots);
        EXPECT_EQ(a.has_turn, b.has_turn);
    };
    same_space(body.facing, source.facing);
    same_space(body.lateral, source.lateral);
    ASSERT_EQ(body.styles.size(), 2u);
    same_space(body.styles[1].space, source.styles[1].space);
    EXPECT_EQ(body.side_travel, source.side_travel);
    EXPECT_EQ(body.custom_names, source.custom_names);
    const Program &program = pack.program, &was = whole().program;
    EXPECT_EQ(program.state_size, was.state_size);
    EXPECT_EQ(program.inertializes, was.inertializes);
    EXPECT_EQ(program.inertia_memory, was.inertia_memory);
    EXPECT_EQ(program.registers, was.registers);
    EXPECT_EQ(program.drifting, was.drifting);
    ASSERT_EQ(program.nodes.size(), was.nodes.size());
    for (std::size_t i = 0; i < was.nodes.size(); ++i) {
        EXPECT_EQ(program.nodes[i].first, was.nodes[i].first);
        EXPECT_EQ(program.nodes[i].follows, was.nodes[i].follows);
        EXPECT_EQ(program.nodes[i].memory, was.nodes[i].memory);
        if (const auto* space = std::get_if<SpaceNode>(&was.nodes[i].data))
            same_space(std::get<SpaceNode>(program.nodes[i].data).space, space->space);
    }
    ASSERT_EQ(program.rigs.size(), 1u);
    const LiveRig &rig = *program.rigs[0], &rig_was = *was.rigs[0];
    EXPECT_EQ(rig.stand, rig_was.stand);
    EXPECT_EQ(rig.limb, rig_was.limb);
    EXPECT_EQ(rig.change_seconds, rig_was.change_seconds);
    EXPECT_EQ(rig.stand_place, rig_was.stand_place);
    EXPECT_EQ(rig.idle_values, rig_was.idle_values);
    EXPECT_EQ(rig.idle_to_stand, rig_was.idle_to_stand);
    EXPECT_EQ(rig.idle_hz, rig_was.idle_hz);
    EXPECT_EQ(rig.lanes.size(), rig_was.lanes.size());
}

TEST(Pack, keyframes_are_pointed_at_where_they_lie_and_stored_once) {
    const Pack pack = opened(whole_bytes());
    const auto inside = [](const auto& table) {
        const auto* at = reinterpret_cast<const std::byte*>(table.data());
        return at >= whole_bytes().data() && at < whole_bytes().data() + whole_bytes().size();
    };
    int small = 0;
    for (const PackedClip& clip : pack.graph().clips) {
        if (!clip.small.empty()) {
            ++small;
            EXPECT_TRUE(inside(clip.small.middle)) << clip.name;
            EXPECT_TRUE(inside(clip.small.curves.words)) << clip.name;
            continue;
        }
        EXPECT_TRUE(inside(clip.rotations)) << clip.name;
        EXPECT_TRUE(inside(clip.root)) << clip.name;
    }
    EXPECT_EQ(small, 1);
    Pack twice = whole();
    for (const PackedClip& clip : whole().graph().clips) twice.program.body.clips.push_back(clip);
    const std::size_t more = pack_bytes(twice).size() - whole_bytes().size();
    EXPECT_LT(more, whole().graph().clips.size() * 1024);  // definitions alone, not keyframes
    EXPECT_GT(whole_bytes().size(), 100'000u);
}

TEST(Pack, steady_frames_of_an_opened_pack_allocate_nothing) {
    const Pack pack = opened(whole_bytes());
    GraphScratch scratch(pack.program);
    GraphFrame frame(pack.program);
    std::vector<std::byte> state(pack.program.state_size);
    std::vector<Transform> locals(pack.skeleton().rest.size());
    start(pack.program, state);
    const long before = test::allocation_count();
    for (int f = 0; f < 120; ++f) {
        GraphInput input;
        input.dt = 1.0f / 60;
        update(pack.program, state, input, scratch, frame);
        pose(pack.program, state, frame, scratch, locals);
    }
    EXPECT_EQ(test::allocation_count(), before);
}

TEST(Pack, lies_anywhere_that_is_aligned) {
    std::vector<std::byte> room(whole_bytes().size() + 96);
    const auto start = reinterpret_cast<std::uintptr_t>(room.data());
    std::byte* const at = room.data() + (64 - start % 64) % 64 + 4;
    std::memcpy(at, whole_bytes().data(), whole_bytes().size());
    const Pack pack = opened({at, whole_bytes().size()});
    EXPECT_TRUE(Played(pack, 60) == Played(whole(), 60));
}

TEST(Pack, says_what_is_wrong_at_which_byte_and_what_to_do) {
    const auto why_after = [](const auto& change) {
        std::vector<std::byte> bytes = whole_bytes();
        change(bytes);
        std::string why;
        EXPECT_FALSE(Pack::open(bytes, &why));
        return why;
    };
    const auto put = [](std::size_t at, auto value) {
        return [=](std::vector<std::byte>& bytes) { std::memcpy(bytes.data() + at, &value, sizeof value); };
    };
    EXPECT_EQ(why_after([](auto& bytes) { bytes.resize(10); }),
              "it is 10 bytes long, less than a pack's header; read the whole file");
    EXPECT_EQ(why_after(put(0, std::uint32_t{0x46546c67})),
              "byte 0: it does not begin like a pack; make one with `surefoot bake`, and read it as binary");
    EXPECT_EQ(why_after(put(8, std::uint32_t{3})),
              "byte 8: it is a pack of version 3, and this library reads 2; bake it again");
    EXPECT_EQ(why_after([](auto& bytes) { bytes.pop_back(); }),
              "byte 16: it should be " + std::to_string(whole_bytes().size()) + " bytes long and has " +
                  std::to_string(whole_bytes().size() - 1) + "; read the whole file and nothing else");
    EXPECT_EQ(why_after([](auto& bytes) { bytes[5000] ^= std::byte{1}; }),
              "byte 24: its checksum does not hold, so it has been damaged; copy it anew, or bake it again");
    std::string why;
    EXPECT_FALSE(Pack::open(std::span(whole_bytes()).subspan(0, 0), &why));
    std::vector<std::byte> shifted(whole_bytes().size() + 1);
    std::copy(whole_bytes().begin(), whole_bytes().end(), shifted.begin() + 1);
    EXPECT_FALSE(Pack::open(std::span(shifted).subspan(1), &why));
    EXPECT_EQ(why, "it does not lie at a multiple of 4 bytes; align it to 64");
}

/// What a writer would have to be wrong to write; `open` must not rely on its being right.
TEST(Pack, refuses_definitions_that_make_no_sense) {
    const auto why = [](const auto& change) {
        Pack pack = whole();
        change(pack);
        std::string text;
        const std::vector<std::byte> bytes = pack_bytes(pack);
        EXPECT_FALSE(Pack::open(bytes, &text));
        return text.substr(0, text.find(';'));
    };
    EXPECT_EQ(why([](Pack& p) { p.program.nodes.back().children.back() = 2000; }),
              "a node hangs on one that does not come before it");
    EXPECT_EQ(why([](Pack& p) { p.standing.pop_back(); }), "the standing pose does not match the joints");
    EXPECT_EQ(why([](Pack& p) { p.legs.side[0].foot = 500; }), "a leg names a joint that is not there");
    EXPECT_EQ(why([](Pack& p) { p.program.body.legs.joint[2] = 500; }),
              "the paths of the legs name a joint that is not there");
    EXPECT_EQ(why([](Pack& p) { p.roles.set(Role::head, 900); }), "a role names a joint that is not there");
    EXPECT_EQ(why([](Pack& p) { p.program.body.clips[0].frame_count += 1; }),
              "clip 'idle' has rotations that do not match its frames and joints");
    EXPECT_EQ(why([](Pack& p) {
                  p.program.body.clips[0].rotations.edit([](auto& keys) { std::fill(keys.begin(), keys.end(), 0); });
              }),
              "clip 'idle' has a key that is no rotation");
    const auto jog = [](Pack& p) -> PackedClip& {
        return p.program.body.clips[static_cast<std::size_t>(p.clip("jog"))];
    };
    EXPECT_EQ(why([&](Pack& p) { jog(p).small.curves.numbers[3] = 60000; }),
              "clip 'jog' has a curve of a number that is not there");
    EXPECT_EQ(why([&](Pack& p) { jog(p).small.curves.groups[0].intervals += 1; }),
              "clip 'jog' has curves that do not match their keys");
    EXPECT_EQ(why([&](Pack& p) { jog(p).small.moving_middle.clear(); }),
              "clip 'jog' has curves that do not match its joints");
    EXPECT_EQ(why([&](Pack& p) { jog(p).feet[1].small.curves.number_count = 8; }),
              "clip 'jog' has footprint curves that do not match it");
    EXPECT_EQ(why([&](Pack& p) {
                  jog(p).feet[0].small.middle.toes = {0, 0, 0, 0};
              }),
              "clip 'jog' has a key that is no rotation");
    EXPECT_EQ(
        why([&](Pack& p) { jog(p).small.middle.edit([](auto& keys) { std::fill(keys.begin(), keys.end(), 0); }); }),
        "clip 'jog' has a key that is no rotation");
    EXPECT_EQ(why([](Pack& p) { p.program.body.facing.clips[0] = 99; }),
              "space 'facing' names a clip that is not there");
    const auto ends = [](const std::string& text, const std::string& end) {
        EXPECT_TRUE(text.size() > end.size() && text.substr(text.size() - end.size()) == end) << text;
    };
    ends(why([](Pack& p) { p.hip_height = std::numeric_limits<float>::infinity(); }),
         " is no number, or too large a one");
    ends(why([](Pack& p) { p.program.name = "\xff"; }), " ends a text that is no UTF-8");
    ends(why([](Pack& p) { p.program.parameters[0].kind = static_cast<ParameterKind>(9); }),
         " names a choice that is not known");
    ends(why([](Pack& p) {
             p.program.body.clips[2].root.edit(
                 [](auto& root) { root[1].yaw = std::numeric_limits<float>::quiet_NaN(); });
         }),
         " names a table with what is no number, or too large a one");
}

// A change of format that k_pack_version does not tell is caught here. After one that it does, this writes the new
// file: SUREFOOT_WRITE_GOLDEN=1 test_pack_file --gtest_filter=*golden*
TEST(Pack, the_golden_file_of_this_version_opens_and_comes_back_byte_for_byte) {
    const auto file = std::filesystem::path(SUREFOOT_SOURCE_DIR) / "tests/pack_file" /
                      ("version_" + std::to_string(k_pack_version) + ".sfpack");
    if (std::getenv("SUREFOOT_WRITE_GOLDEN")) {
        const std::vector<std::byte> made = pack_bytes(test::small_pack());
        write_file(file, {reinterpret_cast<const char*>(made.data()), made.size()});
    }
    const std::string text = read_file(file);
    std::vector<std::byte> bytes(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
    const Pack pack = opened(bytes);
    EXPECT_EQ(pack_bytes(pack), bytes);
    EXPECT_EQ(pack.program.parameter("wave"), 3);
    EXPECT_EQ(pack.program.nodes.size(), whole().program.nodes.size());
    EXPECT_EQ(pack.graph().styles[1].mask.at(static_cast<std::size_t>(pack.roles[Role::head])), 0.75f);
    Played(pack, 60);
}

TEST(Pack, the_same_source_gives_the_same_bytes) { EXPECT_EQ(pack_bytes(test::whole_pack()), whole_bytes()); }

}  // namespace
}  // namespace surefoot
