// Textures: images, and the colors that they give to the faces of OBJ and glTF files.
#include <fmt/format.h>

#include <array>
#include <optional>

#include "clench/base/error.h"
#include "clench/io/mesh/image_file.h"
#include "clench/io/mesh/mesh_readers.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::Warnings;

namespace {

// 4 x 2 pixels: red, red, green, green above blue, blue, white, white
const std::string png_base64 =
    "iVBORw0KGgoAAAANSUhEUgAAAAQAAAACCAIAAADwyuo0AAAAE0lEQVR42mP4z8AARAxQCkxDAAB1pAv1o+b0"
    "cwAAAABJRU5ErkJggg==";
// 16 x 8 pixels: the left half (200, 20, 20), the right half (20, 60, 200)
const std::string jpeg_base64 =
    "/9j/2wBDAAMCAgMCAgMDAwMEAwMEBQgFBQQEBQoHBwYIDAoMDAsKCwsNDhIQDQ4RDgsLEBYQERMUFRUVDA8X"
    "GBYUGBIUFRT/2wBDAQMEBAUEBQkFBQkUDQsNFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQU"
    "FBQUFBQUFBQUFBQUFBT/wAARCAAIABADAREAAhEBAxEB/8QAFQABAQAAAAAAAAAAAAAAAAAABQj/xAAUEAEA"
    "AAAAAAAAAAAAAAAAAAAA/8QAFgEBAQEAAAAAAAAAAAAAAAAACQcI/8QAFBEBAAAAAAAAAAAAAAAAAAAAAP/a"
    "AAwDAQACEQMRAD8Am9L28AhHReP/2Q==";

std::string bytes_of_base64(const std::string& text) {
  static const std::string digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<uint32_t>(digits.find(c));
    held += 6;
    if (held >= 8) out.push_back(static_cast<char>(bits >> (held -= 8) & 255));
  }
  return out;
}

// two triangles of equal size; the first is on the left half of the image, the second on the right
const std::string textured_obj =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"
    "vt 0.05 0.95\nvt 0.2 0.95\nvt 0.05 0.7\nvt 0.8 0.9\nvt 0.9 0.9\nvt 0.9 0.6\n"
    "usemtl wood\nf 1/1 2/2 3/3\nf 2/4 4/5 3/6\n";

bool is_near(const Eigen::Vector3f& a, const Eigen::Vector3f& b, float slack = 0.02f) {
  return (a - b).cwiseAbs().maxCoeff() <= slack;
}

}  // namespace

TEST_CASE("PNG and JPEG images are decoded, rows from the top") {
  const Image png = decode_image(bytes_of_base64(png_base64), "a.png");
  CHECK(png.width == 4);
  CHECK(png.height == 2);
  CHECK(png.pixels == std::vector<uint8_t>{255, 0, 0,   255, 0, 0,   0,   255, 0,   0,   255, 0,
                                           0,   0, 255, 0,   0, 255, 255, 255, 255, 255, 255, 255});
  const Image jpeg = decode_image(bytes_of_base64(jpeg_base64), "a.jpg");
  CHECK(jpeg.width == 16);
  CHECK(jpeg.height == 8);
  CHECK(std::abs(jpeg.pixels[0] - 200) < 6);
  CHECK(std::abs(jpeg.pixels[3 * 15 + 2] - 200) < 6);
}

TEST_CASE("files that are not images, truncated or damaged are rejected by name") {
  CHECK_THROWS_WITH_AS(decode_image("GIF89a", "a.gif"),
                       "a.gif: expected an image in the format PNG or JPEG", Error);
  for (const std::string& whole : {bytes_of_base64(png_base64), bytes_of_base64(jpeg_base64)})
    for (size_t length = 4; length + 12 < whole.size(); ++length)
      CHECK_THROWS_AS(decode_image(whole.substr(0, length), "a"), Error);
  // an image whose header states a size above the limit
  std::string huge = bytes_of_base64(png_base64);
  huge[16] = huge[20] = 0x10;
  CHECK_THROWS_AS(decode_image(huge, "a.png"), Error);
}

TEST_CASE("images of one file are refused when they have too many pixels in all") {
  ImageBudget budget;
  budget.add(1 << 13, 1 << 13, "a");
  budget.add(1 << 13, 1 << 13, "b");
  CHECK_THROWS_WITH_AS(budget.add(1, 1, "c.png"),
                       "c.png: expected images of at most 134217728 pixels in all", Error);
}

TEST_CASE("the mean color of a patch is that of its pixels, also beyond the image's edges") {
  const Image image = decode_image(bytes_of_base64(png_base64), "a.png");
  const auto mean = [&](double u, double v) {
    const Eigen::Vector2d corners[] = {{u, v}, {u + 0.1, v}, {u, v + 0.1}};
    return mean_color(image, corners);
  };
  CHECK(mean(0.1, 0.1) == Eigen::Vector3f(1, 0, 0));
  CHECK(mean(0.7, 0.1) == Eigen::Vector3f(0, 1, 0));
  CHECK(mean(0.1, 0.7) == Eigen::Vector3f(0, 0, 1));
  CHECK(mean(-0.9, 3.1) == Eigen::Vector3f(1, 0, 0));
  const Eigen::Vector2d all[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  CHECK(is_near(mean_color(image, all), {0.5f, 0.5f, 0.5f}, 0.06f));
}

TEST_CASE("faces of an OBJ file have the colors of its texture, times that of the material") {
  const TemporaryFolder folder;
  folder.write("a.png", bytes_of_base64(png_base64));
  folder.write("a.mtl", "newmtl wood\nmap_Kd a.png\n");
  const auto file = folder.write("a.obj", textured_obj);
  const Appearance plain = read_body(file).appearance;
  CHECK(plain.given);
  REQUIRE(plain.triangle_colors.size() == 2);
  CHECK(plain.triangle_colors[0] == Eigen::Vector3f(1, 0, 0));
  CHECK(plain.triangle_colors[1] == Eigen::Vector3f(0, 1, 0));
  folder.write("a.mtl", "newmtl wood\nKd 0.5 0.25 1\nmap_Kd -s 1 1 1 a.png\n");
  const Appearance dim = read_body(file).appearance;
  REQUIRE(dim.triangle_colors.size() == 2);
  CHECK(dim.triangle_colors[0] == Eigen::Vector3f(0.5f, 0, 0));
  CHECK(dim.triangle_colors[1] == Eigen::Vector3f(0, 0.25f, 0));
}

TEST_CASE("a texture that cannot be read leaves the color of the material, with a warning") {
  const TemporaryFolder folder;
  const auto file = folder.write("a.obj", textured_obj);
  for (const std::optional<std::string>& image :
       {std::optional<std::string>(), std::optional<std::string>("no image")}) {
    if (image) folder.write("a.png", *image);
    folder.write("a.mtl", "newmtl wood\nKd 0.5 0.25 1\nmap_Kd a.png\n");
    Warnings warnings;
    const BodySpec body = read_body(file, warnings.options());
    CHECK(body.appearance.color == Eigen::Vector3f(0.5f, 0.25f, 1));
    REQUIRE(warnings.list.size() == 1);
    CHECK(warnings.list[0].find("the color of the material is used") != std::string::npos);
  }
}

TEST_CASE("triangles of a glTF file have the colors of their base color texture") {
  const TemporaryFolder folder;
  // positions of three corners and their texture coordinates, as 32-bit numbers
  const float numbers[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.6f, 0.1f, 0.9f, 0.1f, 0.6f, 0.4f};
  folder.write("a.bin", std::string(reinterpret_cast<const char*>(numbers), sizeof numbers));
  const auto file =
      folder.write("a.gltf",
                   R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
  "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1},
    "material": 0}]}], "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
  "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,)" +
                       png_base64 + R"("}],
  "buffers": [{"uri": "a.bin", "byteLength": 60}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
    {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}]})");
  const Appearance looks = read_body(file).appearance;
  CHECK(looks.given);
  CHECK(looks.color == Eigen::Vector3f(0, 1, 0));
}

// --- coordinates in images ---

namespace {

// u and v of a corner by its position, which is unique in these meshes
Eigen::Vector2f place_at(const BodySpec& body, const Eigen::Vector3d& p) {
  const Mesh& mesh = body.shape->mesh();
  for (size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if ((mesh.vertices[mesh.triangles[i][k]] - p).norm() < 1e-9)
        return body.appearance.skin->triangles[i].uv[k];
  FAIL("no such vertex");
  return {};
}

bool is_at(const Eigen::Vector2f& uv, float u, float v) {
  return (uv - Eigen::Vector2f(u, v)).norm() < 1e-5f;
}

// a closed tetrahedron in meters; vt i belongs to vertex i
std::string textured_tetrahedron(bool inside_out) {
  std::string text =
      "mtllib a.mtl\nusemtl wood\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
      "vt 0.1 0.2\nvt 0.9 0.2\nvt 0.5 0.8\nvt 0.25 0.5\n";
  for (std::array<int, 3> f : {std::array{1, 3, 2}, {1, 2, 4}, {1, 4, 3}, {2, 3, 4}}) {
    if (inside_out) std::swap(f[1], f[2]);
    text += fmt::format("f {0}/{0} {1}/{1} {2}/{2}\n", f[0], f[1], f[2]);
  }
  return text;
}

const char* const collada_effect = R"(<?xml version="1.0"?>
<COLLADA version="1.4.1"><asset><up_axis>Z_UP</up_axis></asset>
<library_images><image id="img"><init_from>my%20wood.png</init_from></image></library_images>
<library_effects><effect id="fx"><profile_COMMON>
<newparam sid="surf"><surface type="2D"><init_from>img</init_from></surface></newparam>
<newparam sid="samp"><sampler2D><source>surf</source><wrap_s>MIRROR</wrap_s></sampler2D></newparam>
<technique sid="t"><lambert><diffuse><texture texture="samp" texcoord="CH"/></diffuse></lambert>
</technique></profile_COMMON></effect></library_effects>
<library_materials><material id="mat"><instance_effect url="#fx"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"><param name="X"/><param name="Y"/>
<param name="Z"/></accessor></technique_common></source>
<source id="uv"><float_array id="ua" count="8">0 0 1 0 1 1 0 1</float_array>
<technique_common><accessor source="#ua" count="4" stride="2"><param name="S"/><param name="T"/>
</accessor></technique_common></source>
<source id="other"><float_array id="oa" count="2">0.5 0.5</float_array>
<technique_common><accessor source="#oa" count="1" stride="2"><param name="S"/><param name="T"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist material="M" count="1"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#other" offset="1" set="0"/>
<input semantic="TEXCOORD" source="#uv" offset="2" set="1"/>
<vcount>4</vcount><p>0 0 0 1 0 1 2 0 2 3 0 3</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="M" target="#mat">
<bind_vertex_input semantic="CH" input_semantic="TEXCOORD" input_set="1"/></instance_material>
</technique_common></bind_material></instance_geometry></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";

}  // namespace

TEST_CASE("triangles of an OBJ file keep their places in its image") {
  const TemporaryFolder folder;
  folder.write("a.png", bytes_of_base64(png_base64));
  folder.write("a.mtl", "newmtl wood\nmap_Kd a.png\n");
  for (const bool inside_out : {false, true}) {
    const BodySpec body = read_body(folder.write("a.obj", textured_tetrahedron(inside_out)));
    CHECK(body.mesh_report->flipped == inside_out);
    REQUIRE(body.appearance.skin);
    REQUIRE(body.appearance.skin->textures.size() == 1);
    CHECK(body.appearance.skin->textures[0].image->width == 4);
    CHECK(body.appearance.skin->textures[0].wrap_u == Wrap::repeat);
    CHECK(is_at(place_at(body, {0, 0, 0}), 0.1f, 0.8f));  // v of OBJ points up
    CHECK(is_at(place_at(body, {1, 0, 0}), 0.9f, 0.8f));
    CHECK(is_at(place_at(body, {0, 1, 0}), 0.5f, 0.2f));
    CHECK(is_at(place_at(body, {0, 0, 1}), 0.25f, 0.5f));
  }
  folder.write("a.mtl", "newmtl wood\nKd 0.5 1 1\nmap_Kd -clamp on -s 2 4 1 -o 0.1 0 0 a.png\n");
  const BodySpec body = read_body(folder.write("a.obj", textured_tetrahedron(false)));
  const Texture& texture = body.appearance.skin->textures[0];
  CHECK(texture.wrap_u == Wrap::clamp);
  CHECK(texture.tint == Eigen::Vector3f(0.5f, 1, 1));
  CHECK(is_at(place_at(body, {0, 0, 0}), 0.3f, 0.2f));
  // a color set by the user replaces the image
  CHECK_FALSE(
      read_body(folder.write("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).appearance.skin);
}

TEST_CASE("a face of four corners keeps the places of each") {
  const TemporaryFolder folder;
  folder.write("a.png", bytes_of_base64(png_base64));
  folder.write("a.mtl", "newmtl wood\nmap_Kd a.png\n");
  const BodySpec body =
      read_body(folder.write("a.obj",
                             "mtllib a.mtl\nusemtl wood\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                             "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n"));
  REQUIRE(body.appearance.skin);
  for (const auto& p : body.shape->mesh().vertices)
    CHECK(is_at(place_at(body, p), static_cast<float>(p.x()), static_cast<float>(1 - p.y())));
}

TEST_CASE("a glTF file places its image by its sampler and its transform") {
  const TemporaryFolder folder;
  const float numbers[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.6f, 0.1f, 0.9f, 0.1f, 0.6f, 0.4f};
  folder.write("a.bin", std::string(reinterpret_cast<const char*>(numbers), sizeof numbers));
  folder.write("a.png", bytes_of_base64(png_base64));
  const auto file =
      folder.write("a.gltf",
                   R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
  "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1},
    "material": 0}]}], "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 1, 1],
      "baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform":
        {"offset": [0.25, 0], "rotation": 1.5707963267948966, "scale": [2, 1]}}}}}],
  "textures": [{"source": 0, "sampler": 0}], "samplers": [{"wrapS": 33648, "wrapT": 33071}],
  "images": [{"uri": "a.png"}], "buffers": [{"uri": "a.bin", "byteLength": 60}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
    {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}]})");
  const BodySpec body = read_body(file);
  REQUIRE(body.appearance.skin);
  const Texture& texture = body.appearance.skin->textures.at(0);
  CHECK(texture.wrap_u == Wrap::mirror);
  CHECK(texture.wrap_v == Wrap::clamp);
  CHECK(texture.tint == Eigen::Vector3f(0.5f, 1, 1));
  // (u, v) becomes offset + rotation * scale * (u, v): a quarter turn maps u to -v, v to u
  CHECK(is_at(place_at(body, {0, 0, 0}), 0.25f + 0.1f, -1.2f));
}

TEST_CASE("a COLLADA file places the image that its material's sampler leads to") {
  const TemporaryFolder folder;
  const auto file = folder.write("a.dae", collada_effect);
  Warnings warnings;
  const Appearance bare = read_body(file, warnings.options()).appearance;
  CHECK_FALSE(bare.skin);
  REQUIRE(warnings.list.size() == 1);
  CHECK(warnings.list[0].find("my wood.png") != std::string::npos);
  folder.write("my wood.png", bytes_of_base64(png_base64));
  const BodySpec body = read_body(file);
  REQUIRE(body.appearance.skin);
  CHECK(body.appearance.skin->textures.at(0).wrap_u == Wrap::mirror);
  CHECK(body.appearance.skin->textures.at(0).wrap_v == Wrap::repeat);
  for (const auto& p : body.shape->mesh().vertices)
    CHECK(is_at(place_at(body, p), static_cast<float>(p.x()), static_cast<float>(1 - p.y())));
  CHECK(is_near(body.appearance.color, {0.5f, 0.5f, 0.5f}, 0.1f));
}

TEST_CASE("textures do not change what a body is") {
  const TemporaryFolder folder;
  folder.write("a.mtl", "newmtl wood\nmap_Kd a.png\n");
  const auto file = folder.write("a.obj", textured_tetrahedron(true));
  Warnings warnings;
  const BodySpec without = read_body(file, warnings.options());
  CHECK_FALSE(without.appearance.skin);
  folder.write("a.png", bytes_of_base64(png_base64));
  const BodySpec with = read_body(file);
  CHECK(with.appearance.skin);
  CHECK(with.shape->hash() == without.shape->hash());
}
