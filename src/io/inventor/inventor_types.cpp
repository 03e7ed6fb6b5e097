#include "clench/io/inventor/inventor_types.h"

#include <map>

#include "clench/base/text.h"

namespace clench {

namespace {

struct TypeText {
  InventorKind kind;
  std::string_view names;  // names of VRML 2 nodes begin with VRML
  // name[:content[=absent]]: f3 three numbers, F lists; i I b S n N, C colors; w(A|B) one of these
  // words, W any of them
  std::string_view fields;
};

using K = InventorKind;

constexpr std::string_view
    group_fields =
        "children:N bboxCenter bboxSize renderCaching boundingBoxCaching renderCulling pickCulling "
        "url description parameter axisOfRotation collide proxy",
    separator_fields =
        "renderCaching boundingBoxCaching renderCulling pickCulling policy "
        "lassoType lassoPolicy lassoMode color style mode name description "
        "map isActive intensity precision quality shadowCachingEnabled "
        "visibilityNearRadius visibilityRadius epsilon threshold "
        "smoothBorder visibilityFlag",
    listed_fields = "vertexProperty:n startIndex:i=0 numVertices:I=-1",
    indexed_fields =
        "vertexProperty:n coordIndex:I=0 materialIndex:I=-1 normalIndex "
        "textureCoordIndex";

constexpr TypeText read_types[] = {
    {K::group, "Group", ""},
    {K::separator, "LayerGroup", separator_fields},  // of Inventor 1
    {K::separator,
     "Separator Annotation Selection ExtSelection LocateHighlight WWWAnchor ShadowGroup",
     separator_fields},
    {K::transform_separator, "TransformSeparator", ""},
    {K::separator, "VRMLGroup VRMLAnchor VRMLBillboard VRMLCollision", group_fields},
    {K::vrml_transform, "VRMLTransform",
     "children:N bboxCenter bboxSize renderCaching boundingBoxCaching renderCulling pickCulling "
     "translation:f3=0,0,0 rotation:f4=0,0,1,0 scale:f3=1,1,1 scaleOrientation:f4=0,0,1,0 "
     "center:f3=0,0,0"},
    {K::switching, "Switch Blinker", "whichChild:i=-1 speed on"},
    {K::switching, "VRMLSwitch", "whichChoice:i=-1 choice:N"},
    {K::detail, "LOD LevelOfDetail", "center range screenArea"},
    {K::detail, "VRMLLOD", "center range level:N"},
    {K::array, "Array",
     "origin:w(FIRST|CENTER|LAST)=FIRST numElements1:i=1 numElements2:i=1 numElements3:i=1 "
     "separation1:f3=1,0,0 separation2:f3=0,1,0 separation3:f3=0,0,1"},
    {K::copies, "MultipleCopy", "matrix:F16=1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1"},
    {K::include, "File", "name:S"},
    {K::include, "WWWInline", "name:S bboxCenter bboxSize alternateRep"},
    {K::include, "VRMLInline", "url:S bboxCenter bboxSize"},
    {K::transform, "Transform",
     "translation:f3=0,0,0 rotation:f4=0,0,1,0 scaleFactor:f3=1,1,1 scaleOrientation:f4=0,0,1,0 "
     "center:f3=0,0,0"},
    {K::translation, "Translation", "translation:f3=0,0,0"},
    {K::rotation, "Rotation", "rotation:f4=0,0,1,0"},
    {K::rotation_xyz, "RotationXYZ", "axis:w(X|Y|Z)=X angle:f1=0"},
    {K::scale, "Scale", "scaleFactor:f3=1,1,1"},
    {K::matrix, "MatrixTransform", "matrix:f16=1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1"},
    {K::reset, "ResetTransform", "whatToReset:W(TRANSFORM|BBOX)=TRANSFORM"},
    {K::units, "Units",
     "units:w(METERS|CENTIMETERS|MILLIMETERS|MICROMETERS|MICRONS|NANOMETERS|ANGSTROMS|KILOMETERS|"
     "FEET|INCHES|POINTS|YARDS|MILES|NAUTICAL_MILES)=METERS"},
    {K::material, "Material VRMLMaterial",
     "diffuseColor:F3=0.8,0.8,0.8 transparency:F1=0 ambientColor specularColor emissiveColor "
     "shininess ambientIntensity"},
    {K::base_color, "BaseColor", "rgb:F3=0.8,0.8,0.8"},
    {K::packed_color, "PackedColor", "orderedRGBA:C=-858993409 rgba"},
    {K::binding, "MaterialBinding",
     "value:w(OVERALL|PER_PART|PER_PART_INDEXED|PER_FACE|PER_FACE_INDEXED|PER_VERTEX|"
     "PER_VERTEX_INDEXED|DEFAULT|NONE)=OVERALL"},
    // Inventor 1 has the field `hints` instead of the next three; its first four words have no effect
    // on those
    {K::hints, "ShapeHints",
     "hints:W(NONE|SURFACE|UNORDERED|CONCAVE|SOLID|ORDERED|CONVEX)= "
     "vertexOrdering:w(UNKNOWN_ORDERING|CLOCKWISE|COUNTERCLOCKWISE)=UNKNOWN_ORDERING shapeType "
     "faceType:w(UNKNOWN_FACE_TYPE|CONVEX)=CONVEX creaseAngle"},
    {K::coordinates, "Coordinate3", "point:F3=0,0,0"},
    {K::coordinates, "Coordinate4", "point:F4=0,0,0,1"},
    {K::complexity, "Complexity",
     "value:f1=0.5 type:w(OBJECT_SPACE|SCREEN_SPACE|BOUNDING_BOX)=OBJECT_SPACE textureQuality"},
    {K::value, "VertexProperty",
     "vertex:F3= orderedRGBA:C= "
     "materialBinding:w(OVERALL|PER_PART|PER_PART_INDEXED|PER_FACE|PER_FACE_INDEXED|PER_VERTEX|"
     "PER_VERTEX_INDEXED|DEFAULT|NONE)=OVERALL normal texCoord texCoord3 textureUnit "
     "normalBinding"},
    {K::vrml_shape, "VRMLShape", "appearance:n geometry:n renderCaching boundingBoxCaching"},
    {K::appearance, "VRMLAppearance", "material:n texture textureTransform"},
    {K::value, "VRMLCoordinate", "point:F3="},
    {K::value, "VRMLColor", "color:F3="},
    {K::cube, "Cube", "width:f1=2 height:f1=2 depth:f1=2"},
    {K::cube, "VRMLBox", "size:f3=2,2,2"},
    {K::sphere, "Sphere VRMLSphere", "radius:f1=1"},
    {K::cylinder, "Cylinder", "radius:f1=1 height:f1=2 parts:W(SIDES|TOP|BOTTOM|ALL)=ALL"},
    {K::cylinder, "VRMLCylinder", "radius:f1=1 height:f1=2 side:b=1 top:b=1 bottom:b=1"},
    {K::cone, "Cone", "bottomRadius:f1=1 height:f1=2 parts:W(SIDES|BOTTOM|ALL)=ALL"},
    {K::cone, "VRMLCone", "bottomRadius:f1=1 height:f1=2 side:b=1 bottom:b=1"},
    {K::extrusion, "VRMLExtrusion",
     "beginCap:b=1 endCap:b=1 ccw:b=1 convex:b=1 crossSection:F2=1,1,1,-1,-1,-1,-1,1,1,1 "
     "orientation:F4=0,0,1,0 scale:F2=1,1 spine:F3=0,0,0,0,1,0 solid creaseAngle"},
    {K::listed_faces, "FaceSet TriangleStripSet", listed_fields},
    // IndexedTriangleMesh: of Inventor 1, a strip in which -2 swaps the last two corners
    {K::indexed_faces, "IndexedFaceSet IndexedTriangleStripSet IndexedTriangleMesh",
     indexed_fields},
    {K::quad_mesh, "QuadMesh",
     "vertexProperty:n startIndex:i=0 verticesPerColumn:i=1 verticesPerRow:i=1"},
    {K::vrml_faces, "VRMLIndexedFaceSet",
     "coord:n color:n colorPerVertex:b=1 coordIndex:I= colorIndex:I= ccw:b=1 normal texCoord "
     "normalPerVertex normalIndex texCoordIndex solid convex creaseAngle"},
    {K::heights, "VRMLElevationGrid",
     "xDimension:i=0 zDimension:i=0 xSpacing:f1=1 zSpacing:f1=1 height:F1= ccw:b=1 solid "
     "creaseAngle texCoord normal color colorPerVertex normalPerVertex"},
    // their points may be shared with faces
    {K::flat, "IndexedLineSet IndexedPointSet IndexedMarkerSet LineSet PointSet MarkerSet",
     "vertexProperty startIndex numVertices numPoints coordIndex materialIndex normalIndex "
     "textureCoordIndex markerIndex"},
    {K::flat, "VRMLIndexedLineSet VRMLPointSet",
     "coord color colorPerVertex coordIndex colorIndex"},
};

// known only by name: their contents are skipped
constexpr std::pair<InventorKind, std::string_view> skipped_types[] = {
    {K::flat, "AsciiText IndexedNurbsCurve NurbsCurve Text2 Text3 VRMLText"},
    {K::odd_shape, "Image IndexedNurbsSurface NurbsSurface"},
    {K::odd,
     "AntiSquish GeoCoordinate GeoLocation GeoOrigin GeoSeparator PathSwitch Pendulum Rotor "
     "Shuttle SurroundScale"},
    {K::idle,
     "AlphaTest BumpMap BumpMapCoordinate BumpMapTransform CacheHint Callback ClipPlane ColorIndex "
     "DepthBuffer DirectionalLight DrawStyle Environment EventCallback Font FontStyle "
     "FragmentShader FrustumCamera GeometryShader Info Label LightModel LinearProfile Listener "
     "Normal NormalBinding NurbsProfile OrthographicCamera PerspectiveCamera PickStyle PointLight "
     "PolygonOffset ProfileCoordinate2 ProfileCoordinate3 ReversePerspectiveCamera SceneTexture2 "
     "SceneTextureCubeMap ShaderProgram ShadowCulling ShadowDirectionalLight ShadowSpotLight "
     "ShadowStyle SpotLight Texture2 Texture2Transform Texture3 Texture3Transform TextureCombine "
     "TextureCoordinate2 TextureCoordinate3 TextureCoordinateBinding TextureCoordinateCube "
     "TextureCoordinateCylinder TextureCoordinateDefault TextureCoordinateEnvironment "
     "TextureCoordinateNormalMap TextureCoordinateObject TextureCoordinatePlane "
     "TextureCoordinateReflectionMap TextureCoordinateSphere TextureCubeMap "
     "TextureMatrixTransform TextureScalePolicy TextureUnit TransparencyType VertexAttribute "
     "VertexAttributeBinding VertexShader "
     // engines
     "BoolOperation Calculator ComposeMatrix ComposeRotation ComposeRotationFromTo ComposeVec2f "
     "ComposeVec3f ComposeVec4f ComputeBoundingBox Concatenate Counter DecomposeMatrix "
     "DecomposeRotation DecomposeVec2f DecomposeVec3f DecomposeVec4f ElapsedTime Gate "
     "HeightMapToNormalMap InterpolateFloat InterpolateRotation InterpolateVec2f "
     "InterpolateVec3f InterpolateVec4f OnOff OneShot SelectOne TimeCounter TransformVec3f "
     "TriggerAny "
     "VRMLAudioClip VRMLBackground VRMLColorInterpolator VRMLCoordinateInterpolator "
     "VRMLCylinderSensor VRMLDirectionalLight VRMLFog VRMLFontStyle VRMLImageTexture "
     "VRMLMovieTexture VRMLNavigationInfo VRMLNormal VRMLNormalInterpolator "
     "VRMLOrientationInterpolator VRMLPixelTexture VRMLPlaneSensor VRMLPointLight "
     "VRMLPositionInterpolator VRMLProximitySensor VRMLScalarInterpolator VRMLScript VRMLSound "
     "VRMLSphereSensor VRMLSpotLight VRMLTextureCoordinate VRMLTextureTransform VRMLTimeSensor "
     "VRMLTouchSensor VRMLViewpoint VRMLVisibilitySensor VRMLWorldInfo"},
};

/// "translation:f3=0,0,0"
InventorField field_of(std::string_view text) {
  const size_t colon = text.find(':');
  InventorField field{.name = text.substr(0, colon)};
  if (colon == std::string_view::npos) return field;
  const size_t equals = std::min(text.find('='), text.size());
  const std::string_view content = text.substr(colon + 1, equals - colon - 1);
  const auto absent = split_words(text.substr(std::min(equals + 1, text.size())), ",");
  const char letter = content[0];
  field.many = letter >= 'A' && letter <= 'Z';
  if (letter == 'f' || letter == 'F') {
    field.content = InventorField::number;
    field.width = parse_integer(content.substr(1)).value_or(1);
    std::vector<float> numbers;
    for (const auto word : absent)
      numbers.push_back(static_cast<float>(parse_number(word).value_or(0)));
    field.absent = std::move(numbers);
  } else if (letter == 'i' || letter == 'I' || letter == 'C' || letter == 'b') {
    field.content = letter == 'b'   ? InventorField::flag
                    : letter == 'C' ? InventorField::color
                                    : InventorField::integer;
    std::vector<int32_t> numbers;
    for (const auto word : absent) numbers.push_back(parse_integer(word).value_or(0));
    field.absent = std::move(numbers);
  } else if (letter == 'n' || letter == 'N') {
    field.content = InventorField::node;
    field.absent = std::vector<const InventorNode*>();
  } else {
    const bool word = letter == 'w' || letter == 'W';
    field.content = word ? InventorField::word : InventorField::text;
    if (word) field.choices = split_words(content.substr(1), "(|)");
    field.absent = std::vector<std::string>(absent.begin(), absent.end());
  }
  return field;
}

using TypeTable = std::map<std::string_view, InventorType>;

TypeTable all_types() {
  TypeTable out;
  const auto bare = [](std::string_view name) {
    return name.starts_with("VRML") ? name.substr(4) : name;
  };
  for (const auto& [kind, names, fields] : read_types)
    for (const auto name : split_words(names)) {
      InventorType& type = out[name] = {kind, bare(name)};
      for (const auto field : split_words(fields)) type.fields.push_back(field_of(field));
    }
  for (const auto& [kind, names] : skipped_types)
    for (const auto name : split_words(names)) out[name] = {kind, bare(name)};
  return out;
}

}  // namespace

const InventorField* InventorType::field(std::string_view expected) const {
  for (const auto& f : fields)
    if (f.name == expected) return &f;
  return nullptr;
}

const InventorType& inventor_type(std::string_view name, bool vrml2) {
  static const TypeTable types = all_types();
  static const InventorType unknown;
  if (vrml2)
    if (const auto found = types.find("VRML" + std::string(name)); found != types.end())
      return found->second;
  if (const auto found = types.find(name); found != types.end()) return found->second;
  return name.starts_with("So") ? inventor_type(name.substr(2), vrml2) : unknown;
}

}  // namespace clench
