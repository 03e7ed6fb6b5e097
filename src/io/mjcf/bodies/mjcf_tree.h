// Trees of MJCF bodies as links with their joints and geoms.
#pragma once
#include "clench/io/mjcf/document/mjcf_names.h"
#include "clench/io/mjcf/geoms/mjcf_geoms.h"

namespace clench {

/// Meaning of consecutive numbers in a keyframe's qpos: 7 for a free joint, 4 for a ball, 1 for any
/// other.
struct QposSlot {
  enum class Kind { joint, ball, free } kind = Kind::joint;
  int joint = -1;  ///< for a ball: the first of its three hinges

  int size() const { return kind == Kind::free ? 7 : kind == Kind::ball ? 4 : 1; }
};

struct MjcfTree {
  TreeModel model;
  std::vector<LinkPieces> pieces;            ///< one per link
  std::vector<std::vector<MjcfGeom>> geoms;  ///< per link
  std::vector<std::vector<QposSlot>> slots;  ///< per link, for its joints
  std::map<std::string, int> links, joints;  ///< by name
  InertialFaults faults;
};

/// A body directly in the world, with its frame.
struct TopBody {
  const MjcfNode* node = nullptr;
  std::string child_class;
  Pose X_frame;
  std::string name;         ///< in the file; otherwise "body3" for the third body
  int joints = 0;           ///< in it and its descendants, without free joints
  bool own_joints = false;  ///< true if the body itself has a joint
  bool free = false;        ///< true if it moves freely
  bool mocap = false;
};

/// A geom of the world itself.
struct WorldGeom {
  const MjcfNode* node = nullptr;
  std::string child_class;
  Pose X_frame;
};

/// Contents of the world, in the file's order.
struct Worldbody {
  std::vector<TopBody> bodies;
  std::vector<WorldGeom> geoms;
  std::vector<std::pair<bool, int>> order;  ///< true for a body; index
  bool lacks_bodies = false;                ///< true if there are elements that would generate more
};

/// whole  the kind of result that lacks bodies which are not read: "robot" or "world"
Worldbody read_worldbody(MjcfDocument& document, const char* whole);

/// Reports an element that is not read.
/// returns  true if it would generate bodies
bool warn_of_loss(const MjcfNode& node, MjcfDocument& document, const char* whole);

class MjcfTreeReader {
 public:
  /// names  of the file's elements; must outlive this object
  MjcfTreeReader(MjcfDocument& document, MjcfGeoms& geoms, const MjcfNames& names, FileCache& cache,
                 const char* whole);

  /// Adds a frame to which bodies are attached.
  void add_world() { add_link(document_.root().element, "world", -1, {}); }
  /// Reads the body and all its descendants. As the base it is the tree's first link, without a
  /// pose.
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
  const MjcfNames& names_;      // of the file
  std::vector<bool> massless_;  // one per link
  std::set<int> free_;          // links moved by free joints
  // bodies whose mass or inertia is raised to the compiler's bounds
  std::vector<std::string> raised_;
};

}  // namespace clench
