#pragma once
// Every table of keys of the scene file, by the object that it describes.

#include "taut/scene/rows.hpp"

namespace taut::scene_file {

extern const TableOf<Scene> kSceneTable;
extern const TableOf<Accept> kAcceptTable;
extern const TableOf<Wind> kWindTable;
extern const TableOf<Wind::Key> kWindKeyTable;
extern const TableOf<SceneContact> kContactTable;
extern const TableOf<BodyContact> kBodyContactTable;
extern const TableOf<MethodSettings> kMethodTable;
extern const TableOf<Body> kBodyTable;
extern const TableOf<Shape> kGridTable;
extern const TableOf<SpringNetwork> kNetworkTable;
extern const TableOf<Shape> kChainTable;
extern const TableOf<Shape> kSolidBoxTable;
extern const TableOf<Shape> kBallTable;
extern const TableOf<Material> kMaterialTable;
extern const TableOf<Fabric> kFabricTable;
extern const TableOf<FabricBending> kFabricBendingTable;
extern const TableOf<KesReadings> kKesTable;
extern const TableOf<FastReadings> kFastTable;
extern const TableOf<PeirceReadings> kPeirceTable;
extern const TableOf<Material> kSolidMaterialTable;
extern const TableOf<Transform> kTransformTable;
extern const TableOf<Transform> kRotateTable;
extern const TableOf<Collider> kColliderRotateTable; ///< the keys of kRotateTable
extern const TableOf<Pin> kPinTable;
extern const TableOf<Pin> kPinBoxTable;
extern const TableOf<Kinematic> kKinematicTable;
extern const TableOf<MeshSequence> kMeshSequenceTable;
extern const TableOf<Keyframe> kKeyframeTable;
extern const TableOf<Keyframe> kKeyframeRotateTable;
extern const TableOf<Body::Spring> kSpringTable;
extern const TableOf<Collider> kColliderTable;
/// Of the shapes of colliders.
std::span<const Table* const> shape_tables();

/// One for each kind of object, in the order of docs/scene.md.
std::span<const Table* const> all_tables();
/// The table of that name; asserts that it exists.
const Table& table_named(std::string_view name);

} // namespace taut::scene_file
