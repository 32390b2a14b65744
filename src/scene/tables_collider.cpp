// Keys of colliders. Their shapes are parts of one struct.

#include "taut/scene/checker.hpp"
#include "taut/scene/faces.hpp"
#include "taut/scene/tables.hpp"

namespace taut::scene_file {

extern const TableOf<Collider> kPlaneTable;
extern const TableOf<Collider> kSphereTable;
extern const TableOf<Collider> kCapsuleTable;
extern const TableOf<Collider> kCuboidTable;
extern const TableOf<Collider> kDistanceFieldTable;

namespace {

template <ColliderKind K>
void become(Collider& collider)
{
    collider.kind = K;
}

template <ColliderKind K>
bool is(const Collider& collider)
{
    return collider.kind == K;
}

template <ColliderKind K>
constexpr Key shape(std::string_view name, std::string_view what, const TableOf<Collider>& table)
{
    return object(name, what, table).choice().begins<become<K>>().template when<is<K>>();
}

constexpr Key kCollider[] = {
    key<&Collider::name>("name", "for reports").ranges("any text; two of one name are a warning"),
    shape<ColliderKind::plane>("plane", "a half-space", kPlaneTable),
    shape<ColliderKind::sphere>("sphere", "a ball", kSphereTable),
    shape<ColliderKind::capsule>("capsule", "all points near a line", kCapsuleTable),
    shape<ColliderKind::cuboid>("cuboid", "a box, turned as you like", kCuboidTable),
    shape<ColliderKind::distance_field>("distance_field", "any closed surface, by a grid of distances to it",
                                        kDistanceFieldTable),
    key<&Collider::friction>("friction", "Coulomb's coefficient; 0: no friction effect")
        .unit("(Coulomb coefficient)")
        .at_least(0),
    key<&Collider::meets>("meets",
                          "what of a body it pushes: its vertices, or points of its triangles, too, so that "
                          "nothing comes through between vertices; \"automatic\": triangles, too, where it "
                          "could stand out by a quarter of the largest hole between vertices")
        .see("which", "contact.md#colliders-and-triangles"),
    list<&Collider::motion>("motion", "how it moves", kKeyframeTable),
};

constexpr Stranger kStrangeToColliders[] = {
    {"mesh",
     "a mesh that bodies run into is one of the bodies: {\"mesh\": \"torso.obj\", \"kinematic\": {}}; or "
     "`taut sdf` makes a \"distance_field\" of it"},
};

constexpr Key kPlane[] = {
    key<&Collider::point>("point", "a point on it").unit("m"),
    key<&Collider::normal>("normal", "towards the free side; its length does not matter").direction(),
};

constexpr Key kRadius = key<&Collider::radius>("radius", "of its surface").unit("m").above(0);

constexpr Key kSphere[] = {key<&Collider::point>("centre", "its middle").unit("m"), kRadius};

constexpr Key kCapsule[] = {
    key<&Collider::point>("from", "one end of the axis").unit("m"),
    key<&Collider::end>("to", "the other end").unit("m"),
    kRadius.saying("distance of the surface from the axis"),
};

constexpr Key kCuboid[] = {
    key<&Collider::point>("centre", "its middle").unit("m"),
    key<&Collider::half_size>("half_size", "half the edges").unit("m").above(0),
    object("rotate", "about the centre", kColliderRotateTable),
};

constexpr Key kDistanceField[] = {
    key<&Collider::field_file>(
        "file", "the grid, as `taut sdf` and SDFGen write it; the path is relative to the scene file")
        .needed(),
    key<&Collider::point>("origin", "where the origin of the file lies").unit("m"),
    key<&Collider::field_scale>("scale", "of the file's lengths; 0.01 for centimetres").above(0),
    object("rotate", "about the origin of the file", kColliderRotateTable),
};

} // namespace

constinit const TableOf<Collider> kColliderTable = TableOf<Collider>("collider", kCollider)
                                                       .choosing(Choice::exactly_one)
                                                       .strange(kStrangeToColliders)
                                                       .checks<check_collider>();
constinit const TableOf<Collider> kPlaneTable("plane", kPlane);
constinit const TableOf<Collider> kSphereTable("sphere", kSphere);
constinit const TableOf<Collider> kCapsuleTable("capsule", kCapsule);
constinit const TableOf<Collider> kCuboidTable("cuboid", kCuboid);
constinit const TableOf<Collider> kDistanceFieldTable("distance_field", kDistanceField);

std::span<const Table* const> shape_tables()
{
    static constexpr const Table* tables[] = {&kPlaneTable, &kSphereTable, &kCapsuleTable, &kCuboidTable,
                                              &kDistanceFieldTable};
    return tables;
}

} // namespace taut::scene_file
