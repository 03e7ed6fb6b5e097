namespace clench {
namespace other {
struct Twice {};
}
struct Mine {};
class alignas(16) Twice {};
}
