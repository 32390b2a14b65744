// Keys of the scene itself: time, world, and what else it holds.

#include "taut/scene/checker.hpp"
#include "taut/scene/field.hpp"
#include "taut/scene/tables.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <vector>

namespace taut::scene_file {
namespace {

constexpr int kVersion = 1;

void read_version(const Field& scene, Scene& out)
{
    if (const auto version = scene.find("taut"))
        if (version->count() != kVersion)
            version->refuse("this library reads version 1");
    out.version = kVersion;
}

void begin_wind(Wind& wind) { wind.density = 1.2; }
void begin_contact(SceneContact& contact) { contact.between = true; }

constexpr Key kScene[] = {
    key<&Scene::version>("taut", "version of the format")
        .range(kVersion, kVersion)
        .needed("write \"taut\": 1, the version of the format")
        .reads<read_version>(),
    key<&Scene::name>("name", "for reports").usually("the file's name"),
    key<&Scene::timestep>("timestep", "time between two frames")
        .unit("s")
        .above(0)
        .at_most(1)
        .code(ErrorCode::bad_timestep)
        .usually("1/60")
        .ranges("above 0, to 1; a substep at least 1e-15 (else `bad_timestep`)"),
    key<&Scene::duration>("duration", "simulated time")
        .unit("s")
        .at_least(0)
        .ranges("0 or more; at most 1e9 time steps"),
    key<&Scene::gravity>("gravity", "acceleration").unit("m/s^2"),
    key<&Scene::damping>("damping", "velocities decay as exp(-damping · t); 0: no damping effect")
        .unit("1/s")
        .at_least(0),
    key<&Scene::max_speed>("max_speed", "vertices are slowed down to it, and the event is counted; "
                                        "0: only the guard against overflow")
        .unit("m/s")
        .at_least(0),
    key<&Scene::depenetration_speed>(
        "depenetration_speed",
        "the fastest way out of a collider that a vertex starts in; in a substep at most "
        "a quarter of the mean side of the elements of the finest body")
        .unit("m/s")
        .at_least(0),
    key<&Scene::external_forces>("external_forces",
                                 "lets the program set forces while it runs; costs a buffer "
                                 "and a pass"),
    object<&Scene::method>("method", "how a step advances", kMethodTable).usually("as below"),
    object<&Scene::accept>("accept", "what a run may leave undone", kAcceptTable).usually("as below"),
    object<&Scene::wind>("wind", "air that cloth moves in; none: no wind effect", kWindTable),
    object<&Scene::contact>("contact", "how the bodies' surfaces meet; none: bodies pass through each other",
                            kContactTable),
    list<&Scene::bodies>("bodies", "what moves; none is a scene, too", kBodyTable),
    list<&Scene::colliders>("colliders", "what bodies run into", kColliderTable),
    ignored<Scene>("$schema",
                   "where an editor finds the [schema](program.md#taut-schema); Taut does not open it")
        .ranges("any text"),
};

constexpr Key kAccept[] = {
    key<&Accept::stretch>(
        "stretch", "strain that may be the solver's own: springs, membranes and tetrahedra strained by "
                   "more must have the energy for it; what a method keeps at its length may "
                   "be off by no more")
        .unit("(a strain)")
        .above(0),
    key<&Accept::residual>("residual",
                           "share of all forces at hand, and four times the share of the motion by "
                           "a body's loads (`load_residual`), that a solve may leave "
                           "(implicit_euler, vbd, xpbd)")
        .unit("(a share of the forces)")
        .above(0),
    key<&Accept::inverted>("inverted", "tetrahedra that may end inside out"),
};

constexpr Key kWind[] = {
    key<&Wind::density>("density", "of the air; 0: no wind effect").unit("kg/m^3").at_least(0),
    key<&Wind::velocity>("velocity", "before the first key").unit("m/s"),
    list<&Wind::keys>("keys", "the wind's velocity over time: linear in between, constant after the last",
                      kWindKeyTable),
};

constexpr Key kWindKey[] = {
    key<&Wind::Key::time>("time", "since the start").unit("s").needed().ascending(),
    key<&Wind::Key::velocity>("velocity", "of the air at that time").unit("m/s").needed(),
};

constexpr Key kContact[] = {
    key<&SceneContact::between>("between", "different bodies meet; bodies say themselves whether they meet "
                                           "themselves"),
    key<&SceneContact::thickness>("thickness", "radius of every surface whose body gives none; two surfaces "
                                               "keep the sum of theirs apart; \"material\": its `thickness`")
        .unit("m")
        .at_least(0)
        .or_word("material"),
    key<&SceneContact::friction>("friction", "Coulomb coefficient of every surface whose body gives none")
        .at_least(0),
    key<&SceneContact::friction_mix>("friction_mix", "what the coefficients of two surfaces that rub make")
        .see("which", "contact.md#what-meets-what"),
    key<&SceneContact::searches>("searches",
                                 "how often a time step, at least, looks for what may meet where "
                                 "surfaces move: more look less far ahead; at most once a substep")
        .range(1, 1000),
    key<&SceneContact::start>("start",
                              "what becomes of surfaces that go through each other at the start: they "
                              "stay so, and the run is `unconverged`; the scene is refused; or they are "
                              "taken apart before the run, and so is what is nearer than its gap"),
    key<&SceneContact::sweeps>("sweeps", "over all pairs, after each iteration of the constraints: more for "
                                         "stacks of many layers")
        .range(1, 100)
        .or_word("automatic", 0)
        .usually("\"automatic\": 8 where a solid that is not led can meet another body or itself, up to 100 "
                 "where it "
                 "may meet light cloth ([rule](contact.md#what-it-does)), else 2"),
    key<&SceneContact::guarantee>("guarantee", "\"no_crossing\": surfaces that meet, and do not cross at the "
                                               "start, never do ([the guarantee](contact.md#the-guarantee))"),
};

constexpr Key kBodyContact[] = {
    key<&BodyContact::self>("self", "the surface meets itself"),
    key<&BodyContact::group>("group", "a name of one's own for bodies that others pass through")
        .ranges("at most 32 different ones in a scene")
        .see("groups", "contact.md#what-meets-what"),
    key<&BodyContact::passes>("passes",
                              "groups whose bodies do not meet this one, nor it them; its own: those "
                              "of the group do not meet each other")
        .ranges("list of groups that bodies have"),
    key<&BodyContact::thickness>("thickness",
                                 "the surface's radius; two surfaces keep the sum of theirs apart")
        .unit("m")
        .at_least(0)
        .or_word("scene"),
    key<&BodyContact::friction>("friction", "Coulomb coefficient").at_least(0).or_word("scene"),
};

} // namespace

constinit const TableOf<Scene> kSceneTable = TableOf<Scene>("scene", kScene).checks<check_scene>();
constinit const TableOf<Accept> kAcceptTable("accept", kAccept);
constinit const TableOf<Wind> kWindTable = TableOf<Wind>("wind", kWind).begins<begin_wind>();
constinit const TableOf<Wind::Key> kWindKeyTable("wind key", kWindKey);

constinit const TableOf<SceneContact> kContactTable =
    TableOf<SceneContact>("contact", kContact).begins<begin_contact>();
constinit const TableOf<BodyContact> kBodyContactTable("body contact", kBodyContact);

std::span<const Table* const> all_tables()
{
    static constexpr const Table* others[] = {
        &kSceneTable, &kAcceptTable, &kMethodTable, &kWindTable, &kWindKeyTable, &kContactTable,
        &kBodyContactTable, &kBodyTable, &kGridTable, &kNetworkTable, &kChainTable, &kSolidBoxTable,
        &kBallTable, &kMaterialTable, &kFabricTable, &kFabricBendingTable, &kKesTable, &kFastTable,
        &kPeirceTable, &kSolidMaterialTable, &kTransformTable, &kRotateTable, &kKinematicTable,
        &kMeshSequenceTable, &kPinTable, &kPinBoxTable, &kKeyframeTable, &kKeyframeRotateTable,
        &kSpringTable, &kColliderTable,
    };
    static const std::vector<const Table*> tables = [] {
        std::vector<const Table*> all(std::begin(others), std::end(others));
        const auto shapes = shape_tables();
        all.insert(all.end(), shapes.begin(), shapes.end());
        return all;
    }();
    return tables;
}

const Table& table_named(std::string_view name)
{
    const auto tables = all_tables();
    const auto found =
        std::find_if(tables.begin(), tables.end(), [&](const Table* t) { return t->name == name; });
    assert(found != tables.end());
    return **found;
}

} // namespace taut::scene_file
