namespace clench {
struct Twice {};
struct Twice::Inner {};
namespace {
struct Mine {};
}
}
