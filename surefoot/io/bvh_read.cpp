#include <surefoot/base/error.h>
#include <surefoot/io/bvh.h>
#include <surefoot/io/clip_name.h>
#include <surefoot/io/joint_names.h>
#include <surefoot/io/node_scene.h>
#include <surefoot/io/unit_scale.h>

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace surefoot {

namespace {

constexpr int k_max_channels_per_joint = 12;
constexpr double k_half_radians_per_degree = k_pi / 360.0;
// Beyond this, degrees carry no angle in a float any more; it also keeps the range reduction exact.
constexpr double k_largest_plain_angle = 1e6;

bool is_blank(char c) noexcept { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_line_end(char c) noexcept { return c == '\n' || c == '\r'; }
char lower(char c) noexcept { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same_word(std::string_view a, std::string_view lower_case) noexcept {
    return a.size() == lower_case.size() &&
           std::equal(a.begin(), a.end(), lower_case.begin(), [](char x, char y) { return lower(x) == y; });
}

std::string counted(std::size_t count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

enum class Channel : std::uint8_t { position_x, position_y, position_z, rotation_x, rotation_y, rotation_z, ignored };

struct JointChannels {
    std::size_t first = 0;  // index of the joint's first number in a frame
    std::array<Channel, k_max_channels_per_joint> kinds{};
    int count = 0;
};

class Reader {
  public:
    Reader(std::string_view text, const std::string& where)
        : begin_(text.data()), at_(begin_), end_(begin_ + text.size()), where_(where) {}

    LoadedClip read();

  private:
    [[noreturn]] void fail(const std::string& problem, const char* remedy = "export the clip again") const {
        const auto line = 1 + std::count(begin_, at_, '\n');
        throw Error(problem, where_ + ":" + std::to_string(line), remedy);
    }
    void skip_blanks() noexcept {
        while (at_ != end_ && is_blank(*at_)) ++at_;
    }
    void skip_space() noexcept {
        while (at_ != end_ && (is_blank(*at_) || is_line_end(*at_) || *at_ == '\0')) ++at_;
    }
    std::string_view peek_word() {
        skip_space();
        const char* p = at_;
        if (p != end_ && (*p == '{' || *p == '}')) return {p, 1};
        while (p != end_ && !is_blank(*p) && !is_line_end(*p) && *p != '{' && *p != '}') ++p;
        return {at_, static_cast<std::size_t>(p - at_)};
    }
    std::string_view word() {
        const std::string_view found = peek_word();
        at_ += found.size();
        return found;
    }
    void expect(std::string_view lower_case, const char* meaning) {
        if (const std::string_view found = peek_word(); !same_word(found, lower_case))
            fail(found.empty() ? std::string("the file ends where ") + meaning + " should stand"
                               : shown(found) + " stands where " + meaning + " should",
                 "check that this is a BVH file");
        word();
    }
    /// A keyword whose colon may stand apart: "Frames:", "frames :".
    void expect_with_colon(std::string_view lower_case, const char* meaning) {
        std::string_view found = peek_word();
        if (!found.empty() && found.back() == ':') found.remove_suffix(1);
        if (!same_word(found, lower_case)) expect(lower_case, meaning);
        at_ += found.size();
        skip_blanks();
        if (at_ != end_ && *at_ == ':') ++at_;
    }
    double number(const char* meaning);
    std::string_view rest_of_line();
    void read_hierarchy();
    void open_joint(int parent);
    void read_end_site(int joint);
    void read_channels(int joint);
    Vec3 read_vector(const char* meaning);
    void read_motion();
    void read_frame(std::size_t frame, std::span<float> numbers);
    [[noreturn]] void fail_short(std::size_t frames) const;
    void pose_joint(const JointChannels& joint, std::span<const float> numbers, Transform& local) const;

    const char* begin_;
    const char* at_;
    const char* end_;
    const std::string& where_;
    Skeleton skeleton_;
    std::vector<JointChannels> channels_;
    std::size_t channel_count_ = 0;
    std::string_view frames_text_;  // how many frames the header promises
    LoadedClip clip_;
};

double Reader::number(const char* meaning) {
    const std::string_view text = word();
    if (text.empty()) fail(std::string("the file ends where ") + meaning + " should stand");
    const char* first = text.data() + (text.front() == '+' ? 1 : 0);
    double value = 0;
    const auto [end, code] = fast_float::from_chars(first, text.data() + text.size(), value);
    if (code != std::errc{} || end != text.data() + text.size())
        fail(shown(text) + " stands where " + meaning + " should");
    if (!std::isfinite(value)) fail(std::string(meaning) + " is " + shown(text) + ", not a finite number");
    return value;
}

std::string_view Reader::rest_of_line() {
    skip_blanks();
    const char* first = at_;
    while (at_ != end_ && !is_line_end(*at_) && *at_ != '{') ++at_;
    const char* last = at_;
    while (last != first && is_blank(last[-1])) --last;
    return {first, static_cast<std::size_t>(last - first)};
}

Vec3 Reader::read_vector(const char* meaning) {
    Vec3 v;
    v.x = static_cast<float>(number(meaning));
    v.y = static_cast<float>(number(meaning));
    v.z = static_cast<float>(number(meaning));
    if (!is_finite(v)) fail(std::string(meaning) + " is too large");
    return v;
}

/// Braces are followed with a stack of our own, so that no depth of nesting can exhaust the machine's.
void Reader::read_hierarchy() {
    if (skip_space(); at_ == end_) throw Error("the file is empty", where_, "export the clip again");
    if (end_ - at_ >= 3 && std::string_view(at_, 3) == "\xef\xbb\xbf") at_ += 3;
    if (!same_word(peek_word(), "hierarchy"))
        fail("not a BVH file: it does not begin with HIERARCHY", "check the file's format and extension");
    word();
    std::vector<int> open;
    for (;;) {
        const std::string_view key = peek_word();
        if (same_word(key, "motion")) {
            if (!open.empty()) fail("MOTION begins before joint " + shown(skeleton_.names[open.back()]) + " is closed");
            return;
        }
        if (key.empty())
            fail(open.empty() ? "the file ends before its MOTION block" : "the file ends inside its hierarchy");
        word();
        if (same_word(key, "root") || same_word(key, "joint")) {
            open_joint(open.empty() ? k_no_joint : open.back());
            open.push_back(skeleton_.joint_count() - 1);
            expect("{", "the '{' of a joint");
        } else if (key == "}") {
            if (open.empty()) fail("a '}' closes nothing");
            open.pop_back();
        } else if (open.empty()) {
            fail(shown(key) + " stands where ROOT or MOTION should", "check that this is a BVH file");
        } else if (same_word(key, "offset")) {
            skeleton_.rest[static_cast<std::size_t>(open.back())].translation = read_vector("an OFFSET");
        } else if (same_word(key, "channels")) {
            read_channels(open.back());
        } else if (same_word(key, "end")) {
            read_end_site(open.back());
        } else {
            fail(shown(key) + " is not known inside a joint", "check that this is a BVH file");
        }
    }
}

void Reader::open_joint(int parent) {
    if (skeleton_.joint_count() == k_max_joints)
        fail("the skeleton has more than " + std::to_string(k_max_joints) + " joints",
             "export fewer joints (no hair, no cloth)");
    skeleton_.add(std::string(rest_of_line()), parent, {});
    channels_.emplace_back();
}

void Reader::read_end_site(int joint) {
    rest_of_line();  // "Site", or a name
    expect("{", "the '{' of an End Site");
    for (;;) {
        const std::string_view key = word();
        if (key == "}") return;
        if (!same_word(key, "offset")) fail(shown(key) + " stands where the OFFSET of an End Site should");
        const Vec3 tip = read_vector("the OFFSET of an End Site");
        Vec3& kept = skeleton_.tips[static_cast<std::size_t>(joint)];
        if (kept == Vec3{}) kept = tip;
    }
}

void Reader::read_channels(int joint) {
    JointChannels& own = channels_[static_cast<std::size_t>(joint)];
    if (own.count > 0) fail("joint " + shown(skeleton_.names[static_cast<std::size_t>(joint)]) + " has two CHANNELS");
    const double count = number("the number of CHANNELS");
    if (!(count >= 0 && count <= k_max_channels_per_joint) || count != std::floor(count))
        fail("a joint cannot have that many CHANNELS");
    own.first = channel_count_;
    own.count = static_cast<int>(count);
    channel_count_ += static_cast<std::size_t>(own.count);
    std::string order;
    for (int i = 0; i < own.count; ++i) {
        const std::string_view name = word();
        Channel kind = Channel::ignored;
        if (!name.empty()) {
            const int axis = lower(name.front()) - 'x';
            const std::string_view what = name.substr(1);
            if (axis < 0 || axis > 2) fail(shown(name) + " is not a channel (such as Xrotation)");
            if (same_word(what, "position"))
                kind = static_cast<Channel>(static_cast<int>(Channel::position_x) + axis);
            else if (same_word(what, "rotation"))
                kind = static_cast<Channel>(static_cast<int>(Channel::rotation_x) + axis);
            else if (same_word(what, "scale"))
                clip_.warnings.push_back("scale channels of joint " +
                                         shown(skeleton_.names[static_cast<std::size_t>(joint)]) + " are left out");
            else
                fail(shown(name) + " is not a channel (such as Xrotation)");
            if (kind >= Channel::rotation_x && kind <= Channel::rotation_z &&
                order.find(static_cast<char>('X' + axis)) == std::string::npos)
                order += static_cast<char>('X' + axis);
        }
        own.kinds[static_cast<std::size_t>(i)] = kind;
    }
    if (clip_.rotation_order.empty() && order.size() == 3) clip_.rotation_order = order;
}

/// Frame times are written with few digits ("0.0083333", "0.033"): the usual rate that this text may stand for, else
/// exactly what it says.
double frame_rate(double frame_time, std::string_view text) {
    const std::size_t point = text.find('.');
    const std::size_t digits = point == std::string_view::npos ? 0 : text.size() - point - 1;
    double last_place = 1;
    for (std::size_t i = 0; i < std::min<std::size_t>(digits, 12); ++i) last_place /= 10;
    for (const double rate : {30.0, 60.0, 120.0, 24.0, 25.0, 50.0, 90.0, 100.0, 240.0, 200.0, 48.0, 72.0, 15.0, 20.0})
        if (std::fabs(frame_time - 1 / rate) < last_place && std::fabs(frame_time * rate - 1) < 0.02) return rate;
    return 1 / frame_time;
}

void Reader::read_motion() {
    expect("motion", "MOTION");
    expect_with_colon("frames", "'Frames:'");
    const std::string_view promised_text = peek_word();
    const double promised = number("the number of frames");
    if (promised < 0 || promised != std::floor(promised)) fail("the number of frames is not a whole number");
    if (promised == 0) fail("the clip has no frames");
    expect("frame", "'Frame Time:'");
    expect_with_colon("time", "'Frame Time:'");
    const std::string_view time_text = peek_word();
    const double frame_time = number("the frame time");
    if (!(frame_time > 1e-5 && frame_time < 100))
        fail("a frame time of " + shown(time_text) + " s is not usable", "write the true frame time into the file");
    if (channel_count_ == 0) fail("no joint has CHANNELS: there is no motion in this file");

    // A number takes at least a digit and a blank: what the header promises is believed only as far as the text can go.
    const double room = std::floor(static_cast<double>(end_ - at_ + 1) / static_cast<double>(2 * channel_count_));
    const double joints = static_cast<double>(skeleton_.joint_count());
    if (std::fmin(promised, room) * joints > static_cast<double>(k_max_transforms_per_file))
        fail(std::string(promised_text) + " frames of " + counted(skeleton_.rest.size(), "joint") + " are more than " +
                 std::to_string(k_max_transforms_per_file) + " joint transforms",
             "cut the clip into several files");
    const auto frames = static_cast<std::size_t>(std::fmin(promised, room));
    clip_.motion.fps = static_cast<float>(frame_rate(frame_time, time_text));
    clip_.motion.root.resize(frames);
    clip_.motion.locals.resize(frames * skeleton_.rest.size());
    frames_text_ = promised_text;
    std::vector<float> numbers(channel_count_);
    for (std::size_t f = 0; f < frames; ++f) {
        read_frame(f, numbers);
        Transform* pose = clip_.motion.locals.data() + f * skeleton_.rest.size();
        for (std::size_t j = 0; j < skeleton_.rest.size(); ++j) {
            pose[j] = skeleton_.rest[j];
            if (channels_[j].count > 0) pose_joint(channels_[j], numbers, pose[j]);
        }
    }
    skip_space();
    if (promised > static_cast<double>(frames)) fail_short(frames);
    if (at_ != end_) clip_.warnings.push_back("numbers follow the last of " + counted(frames, "frame") + ": left out");
    if (frames == 1) clip_.warnings.push_back("only one frame: a pose, not a motion");
}

void Reader::fail_short(std::size_t frames) const {
    fail("the motion block ends after " + std::to_string(frames) + " of " + std::string(frames_text_) + " frames",
         "export the clip again, or mend its 'Frames:' line");
}

void Reader::read_frame(std::size_t frame, std::span<float> numbers) {
    skip_space();
    const auto in_frame = [&] { return "frame " + std::to_string(frame) + " of " + std::string(frames_text_); };
    if (at_ == end_) fail_short(frame);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        skip_blanks();
        if (at_ == end_ || is_line_end(*at_))
            fail(in_frame() + " has " + std::to_string(i) + " of " + counted(numbers.size(), "number"));
        const auto [end, code] = fast_float::from_chars(at_ + (*at_ == '+' ? 1 : 0), end_, numbers[i]);
        if (code != std::errc{} || !std::isfinite(numbers[i]) || (end != end_ && !is_blank(*end) && !is_line_end(*end)))
            fail(in_frame() + ": number " + std::to_string(i) + " is " + shown(peek_word()) + ", not a finite number");
        at_ = end;
    }
    skip_blanks();
    if (at_ != end_ && !is_line_end(*at_) && *at_ != '\0')
        fail(in_frame() + " has more than " + counted(numbers.size(), "number"));
}

void Reader::pose_joint(const JointChannels& joint, std::span<const float> numbers, Transform& local) const {
    double x = 0, y = 0, z = 0, w = 1;
    for (int i = 0; i < joint.count; ++i) {
        const float number = numbers[joint.first + static_cast<std::size_t>(i)];
        const Channel kind = joint.kinds[static_cast<std::size_t>(i)];
        switch (kind) {
            case Channel::position_x:
                local.translation.x = number;
                continue;
            case Channel::position_y:
                local.translation.y = number;
                continue;
            case Channel::position_z:
                local.translation.z = number;
                continue;
            case Channel::ignored:
                continue;
            default:
                break;
        }
        if (number == 0) continue;
        double degrees = static_cast<double>(number);
        if (!(std::fabs(degrees) < k_largest_plain_angle)) degrees = std::fmod(degrees, 360.0);
        const auto [s, c] = sin_cos(degrees * k_half_radians_per_degree);
        // (x, y, z, w) times a rotation by 2 * half about one axis.
        const double a = x, b = y, d = z, e = w;
        if (kind == Channel::rotation_x) {
            x = a * c + e * s, y = b * c + d * s, z = d * c - b * s, w = e * c - a * s;
        } else if (kind == Channel::rotation_y) {
            x = a * c - d * s, y = b * c + e * s, z = d * c + a * s, w = e * c - b * s;
        } else {
            x = a * c + b * s, y = b * c - a * s, z = d * c + e * s, w = e * c - d * s;
        }
    }
    local.rotation =
        normalized(Quat{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(w)});
}

LoadedClip Reader::read() {
    read_hierarchy();
    if (skeleton_.joint_count() == 0) fail("the hierarchy has no joints");
    make_joint_names_unique(skeleton_.names, clip_.warnings);
    read_motion();
    clip_.file = where_;
    clip_.motion.name = file_stem(where_);
    clip_.motion.skeleton = std::make_shared<const Skeleton>(std::move(skeleton_));
    return std::move(clip_);
}

}  // namespace

LoadedClip read_bvh(std::string_view text, const std::string& where, const LoadOptions& options) {
    LoadedClip clip = Reader(text, where).read();
    Motion* const motions[] = {&clip.motion};
    const UnitGuess unit = apply_unit_scale(motions, options.unit_scale);
    clip.unit_scale = static_cast<float>(unit.scale);
    if (!unit.warning.empty()) clip.warnings.push_back(unit.warning);
    if (std::string text = problem(clip.motion); !text.empty()) throw Error(text, where, "export the clip again");
    return clip;
}

}  // namespace surefoot
