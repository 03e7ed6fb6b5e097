// Verdicts of clench.study.shake compared with those of the same test on convex pieces: in Clench's
// engine, and in Bullet.
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/verdicts/bullet_grip.h"
#include "bench/verdicts/our_grip.h"

using namespace clench::bench;

namespace {

struct Options {
  // folder for files that describe each scene by convex pieces, with the verdicts of Clench's
  // engine on them; empty: none are written
  std::string pieces;
  bool in_bullet = false, each = false;
  size_t limit = 1000000;
  GripOptions grip;
  BulletOptions bullet;
  std::vector<std::string> files;
};

struct Verdicts {
  GripVerdict ours, bullet;
};

struct Tally {
  int count = 0, study = 0, ours = 0, bullet = 0, agree = 0, verified = 0, verified_survived = 0;
  void add(const StoredGrasp& grasp, const Verdicts& verdicts) {
    ++count;
    study += grasp.survived, ours += verdicts.ours.survived, bullet += verdicts.bullet.survived;
    agree += verdicts.ours.survived == verdicts.bullet.survived;
    verified += grasp.verified, verified_survived += grasp.verified && verdicts.bullet.survived;
  }
  void print(const std::string& name, bool in_bullet) const {
    std::printf("%-28s %5d %9d %9d", name.c_str(), count, study, ours);
    if (in_bullet)
      std::printf(" %9d %9.1f %% %9d %9d", bullet, count ? 100.0 * agree / count : 0.0, verified,
                  verified_survived);
    std::printf("\n");
    std::fflush(stdout);
  }
};

// the file with convex pieces instead of meshes, and with the verdicts of Clench's engine, for
// tests/bench/verdicts/mujoco.mjs
void write_pieces(const std::string& from, const GripScene& scene,
                  const std::vector<Verdicts>& verdicts, const std::string& to) {
  nlohmann::json all;
  std::ifstream(from) >> all;
  const auto put = [](nlohmann::json& body, const GripBody& of) {
    body.erase("mesh");
    body["pieces"] = nlohmann::json::array();
    for (const Points& piece : of.pieces) {
      auto list = nlohmann::json::array();
      for (const auto& p : piece) list.push_back({p.x(), p.y(), p.z()});
      body["pieces"].push_back(list);
    }
  };
  for (size_t i = 0; i < scene.links.size(); ++i) put(all["hand"]["links"][i], scene.links[i].body);
  put(all["object"], scene.object);
  for (size_t g = 0; g < verdicts.size(); ++g)
    all["grasps"][g]["survived_on_pieces"] = verdicts[g].ours.survived;
  std::ofstream(to) << all;
}

std::vector<Verdicts> judge(const GripScene& scene, const Options& options) {
  std::vector<Verdicts> out(std::min(options.limit, scene.grasps.size()));
  std::vector<std::thread> threads;
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  for (unsigned t = 0; t < cores; ++t)
    threads.emplace_back([&, t] {
      for (size_t g = t; g < out.size(); g += cores) {
        const StoredGrasp& grasp = scene.grasps[g];
        out[g].ours = shake(*our_grip(scene, grasp, options.grip), scene, options.grip);
        if (options.in_bullet)
          out[g].bullet =
              shake(*bullet_grip(scene, grasp, options.grip, options.bullet), scene, options.grip);
      }
    });
  for (std::thread& thread : threads) thread.join();
  return out;
}

Options read_options(int argc, char** argv) {
  Options out;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&] { return ++i < argc ? std::string(argv[i]) : std::string("0"); };
    if (word == "--each")
      out.each = true;
    else if (word == "--bullet")
      out.in_bullet = true;
    else if (word == "--brief")
      out.grip.settle = 0.2, out.grip.seconds = 0.2;
    else if (word == "--pieces")
      out.pieces = value();
    else if (word == "--step")
      out.bullet.step = std::stod(value());
    else if (word == "--kp")
      out.grip.kp = std::stod(value());
    else if (word == "--kd")
      out.bullet.kd = std::stod(value());
    else if (word == "--iterations")
      out.bullet.iterations = std::stoi(value());
    else if (word == "--limit")
      out.limit = std::stoul(value());
    else
      out.files.push_back(word);
  }
  return out;
}

int run(int argc, char** argv) {
  const Options options = read_options(argc, argv);
  if (options.files.empty()) {
    std::cerr << "usage: bench_verdicts [--each] [--brief] [--pieces FOLDER] [--limit COUNT] [--kp "
                 "N] [--bullet [--step S] [--kd N] [--iterations N]] FILE...\n";
    return 2;
  }
  std::printf("%-28s %5s %9s %9s", "held", "of", "by study", "pieces");
  if (options.in_bullet)
    std::printf(" %9s %11s %9s %9s", "in Bullet", "agreement", "verified", "in Bullet");
  std::printf("\n");
  Tally all;
  for (const std::string& file : options.files) {
    const GripScene scene = read_grip_scene(file);
    const std::vector<Verdicts> verdicts = judge(scene, options);
    if (!options.pieces.empty())
      write_pieces(file, scene, verdicts,
                   options.pieces + "/" + file.substr(file.find_last_of('/') + 1));
    Tally tally;
    for (size_t g = 0; g < verdicts.size(); ++g) {
      const StoredGrasp& grasp = scene.grasps[g];
      tally.add(grasp, verdicts[g]), all.add(grasp, verdicts[g]);
      if (!options.each) continue;
      std::printf("  %2zu epsilon %.3f load %.2f, directions held by study %d", g, grasp.epsilon,
                  grasp.load, grasp.held);
      const auto tell = [](const char* name, const GripVerdict& v) {
        std::printf(", %s %d (settled %d, gripping moved it %.1f mm, %.1f degrees)", name, v.held,
                    v.settled, 1e3 * v.moved, v.turned * 57.29578);
      };
      tell("on pieces", verdicts[g].ours);
      if (options.in_bullet) tell("in Bullet", verdicts[g].bullet);
      std::printf("\n");
    }
    tally.print(scene.hand_name + ", " + scene.object_name, options.in_bullet);
  }
  all.print("all", options.in_bullet);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& problem) {
    std::cerr << "bench_verdicts: " << problem.what() << '\n';
    return 1;
  }
}
