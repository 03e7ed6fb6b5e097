// Bodies of an MJCF model that hang on one another, as links with their joints and geoms.
#pragma once
#include "clench/io/mjcf/mjcf_geoms.h"
#include "clench/io/mjcf/mjcf_names.h"

namespace clench {

/// What a row of numbers in a keyframe's qpos stands for: a free joint takes 7, a ball 4, any other
/// 1.
struct QposSlot {
  enum class Kind { joint, ball, free } kind = Kind::joint;
  int joint = -1;  ///< of a ball: the first of its three turns

  int size() const { return kind == Kind::free ? 7 : kind == Kind::ball ? 4 : 1; }
};

struct MjcfTree {
  TreeModel model;
  std::vector<LinkPieces> pieces;            ///< one per link
  std::vector<std::vector<MjcfGeom>> geoms;  ///< likewise
  std::vector<std::vector<QposSlot>> slots;  ///< likewise, of its joints
  std::map<std::string, int> links, joints;  ///< by name
  InertialFaults faults;
};

/// A body directly in the world, with the frame that it stands in.
struct TopBody {
  const MjcfNode* node = nullptr;
  std::string child_class;
  Pose X_frame;
  std::string name;         ///< of its own, else "body3", as the third one
  int joints = 0;           ///< in it and beyond, those that are free left out
  bool own_joints = false;  ///< has it one itself?
  bool free = false;        ///< does it move freely?
  bool mocap = false;
};

/// A geom of the world itself.
struct WorldGeom {
  const MjcfNode* node = nullptr;
  std::string child_class;
  Pose X_frame;
};

/// What stands in the world, in the file's order.
struct Worldbody {
  std::vector<TopBody> bodies;
  std::vector<WorldGeom> geoms;
  std::vector<std::pair<bool, int>> order;  ///< is it a body?, and its number
  bool lacks_bodies = false;                ///< are there elements that would make more?
};

/// whole  what lacks the bodies that are not read: "robot" or "world"
Worldbody read_worldbody(MjcfDocument& document, const char* whole);

/// Reports an element that is not read.
/// returns  would it generate bodies?
bool warn_of_loss(const MjcfNode& node, MjcfDocument& document, const char* whole);

class MjcfTreeReader {
 public:
  /// names  of the file's elements; outlives this
  MjcfTreeReader(MjcfDocument& document, MjcfGeoms& geoms, const MjcfNames& names, FileCache& cache,
                 const char* whole);

  /// A frame that bodies stand on.
  void add_world() { add_link(document_.root().element, "world", -1, {}); }
  /// The body and all that hangs on it. As the base it is the tree's first link, whose own pose is
  /// left out.
  void read_body(const TopBody& body, bool base);
  MjcfTree take();

 private:
  int add_link(const XmlElement& element, const std::string& name, int parent, const Pose& X_PL);
  void read_body(const MjcfNode& node, int parent, const std::string& child_class,
                 const Pose& X_frame, bool base, const std::string& name);
  void read_contents(const MjcfNode& node, int link, const std::string& child_class,
                     const Pose& X_frame);
  void read_joint(const XmlElement& element, int link, const std::string& child_class,
                  const Pose& X_frame);
  void read_free_motion(const XmlValues& values, BodySpec& body);
  static void set_spring_damper(const XmlValues& values, TreeJoint& joint);
  std::string own_name(const XmlElement& element, const std::string& name,
                       const std::map<std::string, int>& taken);
  void add_joint(TreeJoint joint, const XmlElement& element, int link);
  void set_range(const XmlValues& values, TreeJoint& joint);
  void read_inertial(const XmlElement& element, int link, const Pose& X_frame);
  void weigh(const XmlElement& element, int link);
  bool weigh_geoms(int link);
  void bound_inertia(const XmlElement& element, int link);
  void set_massless(int link);
  void check_moving_masses();

  MjcfDocument& document_;
  MjcfGeoms& geoms_;
  FileCache& cache_;
  const char* whole_;
  MjcfTree tree_;
  const MjcfNames& names_;           // of the file
  std::vector<bool> massless_;       // one per link
  std::set<int> free_;               // links that free joints move
  std::vector<std::string> raised_;  // bodies whose mass or inertia the compiler's bounds raise
};

}  // namespace clench
