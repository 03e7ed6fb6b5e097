#include "clench/io/mjcf/geoms/mjcf_textures.h"

#include <algorithm>
#include <cmath>

#include "clench/base/suggest.h"
#include "clench/io/mjcf/geoms/mjcf_patterns.h"

namespace clench {

namespace {

constexpr int max_builtin_side = 1024;  // [pixels]

// --- coordinates in images ---

using TriangleCorners = std::array<Eigen::Vector3d, 3>;

// by x and y in units of half lengths
/// source  MuJoCo XML reference: material/texrepeat, texuniform
TexturedTriangle flat_place(const TriangleCorners& corners, const std::array<double, 2>& repeat) {
  TexturedTriangle out{.texture = 0};
  for (int k = 0; k < 3; ++k)
    out.uv[k] = Eigen::Vector2d(0.5 * repeat[0] * corners[k].x() - 0.5,
                                -0.5 * repeat[1] * corners[k].y() - 0.5)
                    .cast<float>();
  return out;
}

// one row per side: the axes of its image, to the right and down
/// source  OpenGL 3.3, table 3.18: the sides of a cube map
constexpr struct {
  int right, right_sign, down, down_sign;
} cube_axes[] = {{2, -1, 1, -1}, {2, 1, 1, -1}, {0, 1, 2, 1},
                 {0, 1, 2, -1},  {0, 1, 1, -1}, {0, -1, 1, -1}};

TexturedTriangle cube_place(const TriangleCorners& corners) {
  const Eigen::Vector3d middle = corners[0] + corners[1] + corners[2];
  int axis = 0;
  middle.cwiseAbs().maxCoeff(&axis);
  const int side = 2 * axis + (middle[axis] < 0 ? 1 : 0);
  const auto& axes = cube_axes[side];
  TexturedTriangle out{.texture = side};
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d& p = corners[k];
    // a corner may be beyond the edge of the side, on the adjacent one
    const double away = std::max(std::abs(p[axis]), 0.2 * p.cwiseAbs().maxCoeff());
    const double scale = away > 0 ? 0.5 / away : 0;
    out.uv[k] = Eigen::Vector2d(0.5 + scale * axes.right_sign * p[axes.right],
                                0.5 + scale * axes.down_sign * p[axes.down])
                    .cast<float>();
  }
  return out;
}

Eigen::Vector3f mean_of(const Image& image) {
  const Eigen::Vector2d all[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  return mean_color(image, all);
}

}  // namespace

// --- images ---

void MjcfTextures::add(const XmlElement& element) {
  const XmlValues values = document_.values(element);
  const std::string type = values.word("type", {"2d", "cube", "skybox"}, "cube");
  std::string name = values.text("name", "");
  if (name.empty()) name = std::filesystem::path(values.text("file", "")).stem().string();
  if (type == "skybox") {
    textures_.try_emplace(name);
    return document_.unused().element(element);
  }
  if (textures_.contains(name))
    return document_.repairs().add("texture", element.place().of("texture"),
                                   "there is another one of the name '{}'; the first one counts",
                                   excerpt(name));
  document_.unused().attributes(
      element, {"name",     "class",      "type",      "file",       "builtin",   "rgb1",
                "rgb2",     "mark",       "markrgb",   "width",      "height",    "content_type",
                "nchannel", "colorspace", "gridsize",  "gridlayout", "fileright", "fileleft",
                "fileup",   "filedown",   "filefront", "fileback",   "random"});
  textures_[name] = read(values, name);
}

MjcfTextures::Image6 MjcfTextures::read(const XmlValues& values, const std::string& name) {
  Image6 out{.cube = values.text("type", "cube") == "cube"};
  const auto warn = [&](const std::string& sentence) {
    cache_.diagnostics().warn(values.element().place().of("texture '{}'", excerpt(name)), "{}",
                              sentence);
  };
  const std::string kind = values.text("builtin", "none");
  if (kind != "none") {
    MjcfPattern pattern{.kind = kind, .mark = values.text("mark", "none")};
    pattern.width = std::clamp(values.integer("width", 0), 1, max_builtin_side);
    pattern.height =
        out.cube ? pattern.width : std::clamp(values.integer("height", 0), 1, max_builtin_side);
    const auto color = [&](const char* key, const Eigen::Vector3d& fallback) {
      return values.vec3(key, fallback).cwiseMax(0).cwiseMin(1).eval();
    };
    pattern.first = color("rgb1", {0.8, 0.8, 0.8});
    pattern.second = color("rgb2", {0.5, 0.5, 0.5});
    pattern.mark_color = color("markrgb", {0, 0, 0});
    for (int side = 0; side < (out.cube ? 6 : 1); ++side)
      out.sides[side] = pattern_image(pattern, out.cube ? side : -1);
    if (!out.sides[0])
      warn(fmt::format("the built-in pattern {} is not drawn; the color of the material is used",
                       in_quotes(kind)));
    else if (pattern.mark == "random")
      warn("its random marks are not drawn");
    return out;
  }
  if (!values.has("file")) {
    warn("images of several files, or of none, are not drawn; the color of the material is used");
    return out;
  }
  const auto grid = values.numbers("gridsize", 0, 2);
  if (std::ranges::any_of(grid, [](double count) { return count > 1; })) {
    warn("images cut into a grid are not drawn; the color of the material is used");
    return out;
  }
  const auto image = document_.texture_image(values, cache_.options(), files_, warn);
  out.sides.fill(image);
  return out;
}

MjcfTextureUse MjcfTextures::use_of(const MjcfNode& material) const {
  const XmlValues values = document_.values(material.element);
  MjcfTextureUse out{.texture = values.text("texture", "")};
  for (const MjcfNode& layer : material.children)
    if (layer.name() == "layer" && layer.element.attribute("role") == "rgb")
      out.texture = layer.element.attribute("texture").value_or("");
  out.uniform = values.boolean("texuniform", false);
  const auto repeat = values.numbers("texrepeat", 0, 2);
  for (size_t i = 0; i < repeat.size(); ++i) out.repeat[i] = repeat[i];
  return out;
}

// --- geoms ---

void MjcfTextures::dress(const MjcfTextureUse& use, const Eigen::Vector3d& half, bool is_mesh,
                         GeometryPiece& piece) {
  const auto [found, is_unknown] = textures_.try_emplace(use.texture);
  if (is_unknown)
    cache_.diagnostics().warn(Place(document_.file(), 0, "material"),
                              "no texture {}; the color of the material is used",
                              in_quotes(use.texture));
  if (!found->second.sides[0]) return;
  const Image6& image = found->second;
  const Eigen::Vector3f tint = piece.color ? piece.color->color : Eigen::Vector3f::Ones();
  const Eigen::Vector3d unit = use.uniform ? Eigen::Vector3d::Ones() : half;
  SkinPtr& skin =
      skins_[fmt::format("{} {} {} {} {} {} {} {} {} {} {}", use.texture, tint.x(), tint.y(),
                         tint.z(), unit.x(), unit.y(), unit.z(), use.repeat[0], use.repeat[1],
                         is_mesh, static_cast<const void*>(piece.geometry.get()))];
  if (!skin) {
    const Mesh& mesh = piece.geometry->mesh;
    auto made = std::make_shared<Skin>();
    const Wrap wrap = image.cube ? Wrap::clamp : Wrap::repeat;
    for (int side = 0; side < (image.cube ? 6 : 1); ++side)
      made->textures.push_back({image.sides[side], wrap, wrap, tint});
    const SkinPtr& places = piece.geometry->places;
    // directions of meshes are those of their points
    const Eigen::Vector3d divisor = image.cube && is_mesh ? Eigen::Vector3d::Ones() : unit;
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
      TriangleCorners corners = mesh.corners(static_cast<int>(i));
      for (auto& p : corners) p = p.cwiseQuotient(divisor.cwiseMax(1e-12));
      made->triangles.push_back(image.cube ? cube_place(corners) : flat_place(corners, use.repeat));
      if (!image.cube && places) made->triangles.back().uv = places->triangles[i].uv;
    }
    skin = std::move(made);
  }
  piece.skin = skin;
  const float transparency = piece.color ? piece.color->transparency : 0;
  piece.color = PieceColor{mean_of(*image.sides[0]).cwiseProduct(tint), transparency};
}

}  // namespace clench
