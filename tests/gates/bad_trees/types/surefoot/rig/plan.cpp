namespace surefoot {

struct Other;
struct Source {
    int a;
};
struct Stairs {};
struct Hidden {};

namespace {
struct Source {};
}  // namespace

}  // namespace surefoot
