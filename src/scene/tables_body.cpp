// Keys of bodies, but for their shapes and materials; and of how things turn and move.

#include "taut/scene/checker.hpp"
#include "taut/scene/field.hpp"
#include "taut/scene/pin_words.hpp"
#include "taut/scene/read_table.hpp"
#include "taut/scene/tables.hpp"

namespace taut::scene_file {
namespace {

template <ShapeKind K>
void become(Body& body)
{
    body.shape.kind = K;
}

template <ShapeKind K>
bool is(const Body& body)
{
    return body.shape.kind == K;
}

template <ShapeKind K>
constexpr Key shape(const Key& row)
{
    const Key out = row.choice().source().begins<become<K>>().template when<is<K>>();
    return is_solid(K) ? out.solid() : out;
}

bool has_tetrahedra(const Body& body) { return is_solid(body.shape.kind); }

/// The shape has been read before: which defaults and keys there are depends on it.
void read_material(const Field& body, Body& out)
{
    const bool solid = has_tetrahedra(out);
    if (solid)
        out.material = solid_material();
    if (const auto material = body.find("material"))
        read_table(*material, solid ? kSolidMaterialTable : kMaterialTable, &out.material);
}

void read_embedded(const Field& body, Body& out)
{
    const auto file = body.find("embedded");
    if (!file)
        return;
    out.embedded_file = file->text();
    if (out.embedded_file.empty())
        file->refuse("it must name an OBJ, PLY, OFF or STL file, or be left out");
}

void begin_kinematic(Body& body) { body.kinematic.used = true; }
bool is_kinematic(const Body& body) { return body.kinematic.used; }
void begin_box(Pin& pin) { pin.use_box = true; }
bool has_box(const Pin& pin) { return pin.use_box; }
bool has_sequence(const Kinematic& kinematic) { return !kinematic.sequence.file.empty(); }

constexpr Key kBody[] = {
    key<&Body::name>("name", "for reports").ranges("any text; two of one name are a warning"),
    shape<ShapeKind::grid>(object<&Body::shape>("grid", "a rectangle of cloth", kGridTable)),
    shape<ShapeKind::chain>(object<&Body::shape>("chain", "a row of links", kChainTable)),
    shape<ShapeKind::mesh>(key<&Body::shape, &Shape::file>(
        "mesh", "a triangle mesh: .obj, .ply, .off or .stl; the path is relative to the scene file")),
    shape<ShapeKind::box>(object<&Body::shape>("box", "a box of tetrahedra, also a bar", kSolidBoxTable)),
    shape<ShapeKind::ball>(object<&Body::shape>("ball", "a ball of tetrahedra", kBallTable)),
    shape<ShapeKind::tetrahedra>(key<&Body::shape, &Shape::file>(
                                     "tetrahedra", "a file of tetrahedra; left-handed ones are turned, "
                                                   "vertices of none dropped (warnings), ones without "
                                                   "volume refused; the path is relative to the scene file"))
        .see("formats", "scene.md#files-of-tetrahedra"),
    key<&Body::shape, &Shape::weld_distance>(
        "weld_distance", "with `mesh`: vertices this close become one; 0: only equal ones; negative: none")
        .unit("units of the file")
        .only_beside("mesh")
        .source()
        .when<is<ShapeKind::mesh>>(),
    object<&Body::material>("material", "what it is made of", kMaterialTable)
        .of_solids<has_tetrahedra>(kSolidMaterialTable)
        .reads<read_material>()
        .usually("as below"),
    object<&Body::transform>("transform", "where its rest shape stands", kTransformTable)
        .source()
        .usually("as below"),
    object<&Body::contact>("contact", "how its surface meets itself and others", kBodyContactTable)
        .usually("as below"),
    object<&Body::kinematic>("kinematic",
                             "all its vertices are led and nothing moves it: a mesh that others run into",
                             kKinematicTable)
        .begins<begin_kinematic>()
        .when<is_kinematic>(),
    key<&Body::velocity>("velocity", "of all vertices at the start").unit("m/s"),
    list<&Body::pins>("pins", "vertices that are held or led", kPinTable).source(),
    list<&Body::springs>("springs", "further distance constraints", kSpringTable),
    key<&Body::vertex_masses>("vertex_masses", "instead of the masses from shape and density")
        .unit("kg")
        .above(0)
        .ranges("one for each vertex, above 0"),
    key<&Body::start_positions>("start_positions",
                                "where the vertices start, in world space; rest lengths still "
                                "come from the shape")
        .unit("m")
        .ranges("one for each vertex, finite"),
    key<&Body::embedded_file>(
        "embedded",
        "solids: a fine surface that the tetrahedra carry along, .obj, .ply, .off or .stl, in the "
        "frame of the shape; pictures and meshes show it in place of the tetrahedra's own; the path "
        "is relative to the scene file")
        .only_beside("solids")
        .reads<read_embedded>()
        .see("solids.md", "solids.md#embedded-surfaces"),
};

constexpr Key kTransform[] = {
    key<&Transform::translate>("translate", "by which it is moved").unit("m"),
    object("rotate", "by which it is turned", kRotateTable),
    key<&Transform::scale>("scale", "one factor for all axes; 0.01 for a file in centimetres")
        .unit("(no unit)")
        .above(0),
};

template <class Turned>
constexpr Key kAxis = key<&Turned::rotate_axis>("axis",
                                                "counter-clockwise about it; its length does not matter")
                          .unit("(any length but 0)")
                          .ranges("not [0, 0, 0]");
template <class Turned>
constexpr Key kDegrees = key<&Turned::rotate_degrees>("degrees", "the angle").unit("degrees");

constexpr Key kRotate[] = {kAxis<Transform>, kDegrees<Transform>};
constexpr Key kColliderRotate[] = {kAxis<Collider>, kDegrees<Collider>};
constexpr Key kKeyframeRotate[] = {
    kAxis<Keyframe>,
    kDegrees<Keyframe>,
    key<&Keyframe::rotate_centre>("centre", "a point that stays, in world space").unit("m"),
};

constexpr Key kKeyframe[] = {
    key<&Keyframe::time>("time", "since the start").unit("s").needed().ascending(),
    key<&Keyframe::translate>("translate", "by which it is moved").unit("m"),
    object("rotate", "by which it is turned", kKeyframeRotateTable),
};

constexpr Key kKinematic[] = {
    list<&Kinematic::motion>("motion", "how it moves", kKeyframeTable),
    object<&Kinematic::sequence>("sequence", "how it moves and deforms", kMeshSequenceTable)
        .when<has_sequence>(),
    key<&Kinematic::moved_by_program>("moved_by_program", "the program leads its vertices while it runs")
        .see("how", "how-to/move-things-from-a-program.md"),
};

constexpr Key kMeshSequence[] = {
    key<&MeshSequence::file>("file",
                             "a point cache (.pc2) or a folder of .obj files, of the vertices of the body's "
                             "shape in their order and frame; `transform` places it; the path is relative to "
                             "the scene file")
        .needed()
        .source(),
    key<&MeshSequence::rate>("rate", "frames a second; linear in between, the last one stays")
        .unit("1/s")
        .above(0)
        .needed(),
    key<&MeshSequence::start>("start", "time of the first frame").unit("s"),
};

constexpr Key kPin[] = {
    key<&Pin::vertices>("vertices", "numbers of vertices, after welding")
        .choice()
        .ranges("below the body's number of vertices"),
    object("box", "vertices that start inside, border included", kPinBoxTable)
        .choice()
        .begins<begin_box>()
        .when<has_box>()
        .ranges("a `box`; if it holds no vertex: a warning"),
    key<&Pin::corners>("corner", "one corner")
        .choice()
        .single()
        .words(kGridCorners, "grid")
        .words(kChainEnds, "chain"),
    key<&Pin::corners>("corners", "several")
        .choice()
        .words(kGridCorners, "grid")
        .words(kChainEnds, "chain")
        .ranges("list of the same"),
    key<&Pin::edges>("edge", "one edge of a grid").choice().single().words(kGridEdges),
    key<&Pin::edges>("edges", "several").choice().words(kGridEdges).ranges("list of the same"),
    key<&Pin::faces>("face", "one face of a `solid box`: across x, y and z")
        .choice()
        .single()
        .words(kBoxFaces),
    key<&Pin::faces>("faces", "several").choice().words(kBoxFaces).ranges("list of the same"),
    list<&Pin::motion>("motion", "how the vertices are led", kKeyframeTable),
    key<&Pin::moved_by_program>("moved_by_program", "the program leads them while it runs, not `motion`")
        .see("how", "how-to/move-things-from-a-program.md"),
};

constexpr Key kPinBox[] = {
    key<&Pin::box_min>("min", "lower corner").unit("m").needed().ranges("at most `max`"),
    key<&Pin::box_max>("max", "upper corner").unit("m").needed(),
};

constexpr Key kSpring[] = {
    key<&Body::Spring::a>("a", "a vertex").needed().ranges("a vertex of the body"),
    key<&Body::Spring::b>("b", "another vertex").needed().ranges("not `a`"),
    key<&Body::Spring::rest_length>("rest_length", "at which it neither pulls nor presses")
        .unit("m")
        .at_least(0)
        .needed(),
    key<&Body::Spring::compliance>("compliance", "1 / stiffness; 0 is rigid").unit("m/N").at_least(0),
};

} // namespace

constinit const TableOf<Body> kBodyTable =
    TableOf<Body>("body", kBody).choosing(Choice::exactly_one).checks<check_body>();
constinit const TableOf<Transform> kTransformTable("transform", kTransform);
constinit const TableOf<Transform> kRotateTable =
    TableOf<Transform>("rotate", kRotate).checks<check_turn<Transform>>();
constinit const TableOf<Collider> kColliderRotateTable =
    TableOf<Collider>("rotate", kColliderRotate).checks<check_turn<Collider>>();
constinit const TableOf<Keyframe> kKeyframeTable("keyframe", kKeyframe);
constinit const TableOf<Keyframe> kKeyframeRotateTable =
    TableOf<Keyframe>("keyframe rotate", kKeyframeRotate).checks<check_turn<Keyframe>>();
constinit const TableOf<Kinematic> kKinematicTable =
    TableOf<Kinematic>("kinematic", kKinematic).checks<check_kinematic>();
constinit const TableOf<MeshSequence> kMeshSequenceTable("sequence", kMeshSequence);
constinit const TableOf<Pin> kPinTable = TableOf<Pin>("pin", kPin).choosing(Choice::some).checks<check_pin>();
constinit const TableOf<Pin> kPinBoxTable = TableOf<Pin>("box", kPinBox).checks<check_pin_box>();
constinit const TableOf<Body::Spring> kSpringTable =
    TableOf<Body::Spring>("spring", kSpring).checks<check_spring>();

} // namespace taut::scene_file
