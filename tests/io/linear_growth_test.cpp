// The memory that readers allocate, and how often they check for a request to stop, grow linearly
// with the file: one construct is written n times, then 4 n times.
#include <doctest/doctest.h>

#include <cstdlib>
#include <functional>
#include <new>

#include "clench/base/watched.h"
#include "clench/io/grasp_files.h"
#include "read_any.h"
#include "temporary.h"

static thread_local size_t allocated_bytes = 0;

#if !defined(__SANITIZE_ADDRESS__)
static constexpr bool counts_allocations = true;
// the other versions call this one
[[gnu::noinline]] void* operator new(size_t size) {
  allocated_bytes += size;
  if (void* block = std::malloc(size ? size : 1)) return block;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* block) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, size_t) noexcept { std::free(block); }
#else
static constexpr bool counts_allocations = false;
#endif

using namespace clench;
using namespace clench::test;

namespace {

struct Construct {
  std::string name, file, head;
  std::function<std::string(size_t)> item;
  std::string tail;
  size_t count = 200;
};

struct Work {
  size_t bytes = 0, checks = 0;
};

Work work_of(const Construct& one, size_t count) {
  const TemporaryFolder folder;
  std::string text = one.head;
  for (size_t i = 0; i < count; ++i) text += one.item(i);
  const auto path = folder.write(one.file, text + one.tail);
  Watched watched{Progress()};
  const size_t before = allocated_bytes;
  if (one.file.ends_with(".csv") || one.file.ends_with(".jsonl"))
    read_grasp_file(path, {.add = [](GraspSpec&&) {}});
  else if (one.file.ends_with(".xml"))
    read_world(path, {});
  else
    read_any(path, {});
  return {allocated_bytes - before, static_cast<size_t>(watched.checks())};
}

std::string numbered(const std::string& text, size_t i) {
  std::string out = text;
  for (size_t at; (at = out.find('%')) != std::string::npos;) out.replace(at, 1, std::to_string(i));
  return out;
}

Construct repeated_mjcf(const std::string& name, const std::string& head, const std::string& item,
                        const std::string& tail) {
  return {name, "a.xml", "<mujoco>" + head, [=](size_t i) { return numbered(item, i); },
          tail + "</mujoco>"};
}

Construct repeated_urdf(const std::string& name, const std::string& head, const std::string& item,
                        const std::string& tail) {
  return {name, "a.urdf", "<robot name='r'>" + head, [=](size_t i) { return numbered(item, i); },
          tail + "</robot>"};
}

std::vector<Construct> constructs() {
  const std::string ball = "<body name='b%' pos='% 0 0'><freejoint/><geom size='.1'/></body>";
  const std::string arm =
      "<worldbody><body name='a'><joint name='j'/><geom size='.1'/></body></worldbody>";
  std::string balls;
  for (size_t i = 0; i < 20; ++i) balls += numbered(ball, i);
  const std::string world = "<worldbody>" + balls + "</worldbody>";
  const std::string link = "<link name='a'/>";
  return {
      repeated_mjcf("free bodies", "<worldbody>", ball, "</worldbody>"),
      repeated_mjcf("replicates of one body", "<worldbody>",
                    "<replicate count='2' offset='0 1 0'>" + ball + "</replicate>", "</worldbody>"),
      repeated_mjcf("excludes", world + "<contact>", "<exclude body1='b1' body2='b2'/>",
                    "</contact>"),
      repeated_mjcf(
          "pairs",
          "<worldbody><body><freejoint/><geom name='g' size='1'/></body><body><freejoint/>"
          "<geom name='h' size='1'/></body></worldbody><contact>",
          "<pair name='p%' geom1='g' geom2='h'/>", "</contact>"),
      repeated_mjcf("keyframes", world + "<keyframe>", "<key name='k%'/>", "</keyframe>"),
      repeated_mjcf("classes", "<default>", "<default class='c%'><geom size='.1'/></default>",
                    "</default>" + world),
      repeated_mjcf("defaults of many kinds", "<default>", "<x%/>", "</default>" + world),
      repeated_mjcf("materials", "<asset>", "<material name='m%' rgba='1 0 0 1'/>",
                    "</asset>" + world),
      repeated_mjcf("tendons with motors", arm + "<tendon>",
                    "<fixed name='t%'><joint joint='j' coef='1'/></fixed>", "</tendon>"),
      repeated_mjcf("motors", arm + "<actuator>", "<motor name='m%' joint='j'/>", "</actuator>"),
      repeated_mjcf("equalities", arm + "<equality>", "<weld name='w%' body1='a'/>", "</equality>"),
      repeated_mjcf("unknown elements", world, "<y%/>", ""),
      repeated_mjcf("boxes of one body", "<worldbody><body><freejoint/>",
                    "<geom type='box' size='.1 .1 .1' pos='% 0 0'/>", "</body></worldbody>"),
      repeated_mjcf("frames", "<worldbody>", "<frame pos='% 0 0'>" + ball + "</frame>",
                    "</worldbody>"),
      repeated_urdf("elements of other programs", link, "<gazebo reference='x%'><a%/></gazebo>",
                    ""),
      repeated_urdf("materials", link, "<material name='m%'><color rgba='1 0 0 1'/></material>",
                    ""),
      repeated_urdf(
          "boxes of one link", "<link name='a'>",
          "<collision><origin xyz='% 0 0'/><geometry><box size='1 1 1'/></geometry></collision>",
          "</link>"),
      repeated_urdf(
          "links", link,
          "<link name='l%'/><joint name='j%' type='fixed'><parent link='a'/><child link='l%'/>"
          "</joint>",
          ""),
      {"cubes", "a.iv", "#Inventor V2.1 ascii\n",
       [](size_t i) {
         return numbered("Separator { Translation { translation % 0 0 } Cube { } }\n", i);
       },
       ""},
      {"shared cubes", "a.iv", "#Inventor V2.1 ascii\nDEF a Cube { }\n",
       [](size_t) { return "Translation { translation 5 0 0 } USE a\n"; }, ""},
      {"facets on one line", "a.stl", "solid ",
       [](size_t i) {
         return numbered(
             "facet normal 0 0 1 outer loop vertex % 0 0 vertex % 1 0 vertex % 0 1 endloop "
             "endfacet ",
             i);
       },
       "endsolid"},
      {"rows", "a.csv", "x [m],y [m],z [m],qw,qx,qy,qz\n", [](size_t) { return "0,0,0,1,0,0,0\n"; },
       "", 1000},
  };
}

}  // namespace

TEST_CASE("what readers allocate and how often they may stop grow as a file does") {
  for (const Construct& one : constructs()) {
    CAPTURE(one.file);
    CAPTURE(one.name);
    const Work few = work_of(one, one.count), many = work_of(one, 4 * one.count);
    // lists double their memory at some sizes only
    if (counts_allocations) CHECK(many.bytes <= 6 * few.bytes + (1 << 16));
    CHECK(many.checks <= 5 * few.checks + 100);
  }
}
