// Keys of materials, of cloth and of bodies of tetrahedra.

#include "taut/scene/checker.hpp"
#include "taut/scene/fabric_presets.hpp"
#include "taut/scene/field.hpp"
#include "taut/scene/read_table.hpp"
#include "taut/scene/tables.hpp"

#include <limits>

namespace taut::scene_file {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr double kBulkModulus = -1; ///< Material::volume_stiffness of solids: by the other two stiffnesses

// Rows that both have.
constexpr Key kThickness =
    key<&Material::thickness>("thickness", "the gap that is kept from colliders").unit("m").at_least(0);
constexpr Key kSlack =
    key<&Material::attachment_slack>("attachment_slack",
                                     "no vertex goes further from its pin than (1 + this) of the distance at "
                                     "rest; \"none\": no attachment effect")
        .unit("(of the rest distance)")
        .at_least(0)
        .or_word("none");
constexpr Key kFrictionDrag =
    key<&Material::friction_drag>("friction_drag", "of triangles across their normal")
        .unit("(a coefficient)")
        .at_least(0);
constexpr Key kPressure =
    key<&Material::pressure>(
        "pressure", "a closed surface encloses a gas that presses by this more than the air outside at "
                    "the rest volume; negative: it sucks; 0: no pressure effect; not with `tear_strain`")
        .unit("Pa")
        .see("pressure", "effects/pressure.md");
constexpr Key kPressureLaw = key<&Material::pressure_law>(
    "pressure_law", "the pressure stays, or falls as the volume at rest over the volume");
constexpr Key kCreep =
    key<&Material::plastic_creep>("plastic_creep",
                                  "the rate at which strain beyond the yield stays; \"at once\": all of it")
        .unit("1/s")
        .above(0)
        .or_word("at once", kUnbounded);
constexpr Key kPlasticLimit =
    key<&Material::plastic_limit>("plastic_limit", "strain that may stay in all").unit("(a strain)").above(0);

constexpr Key kDensity = key<&Material::density>("density", "mass of an area").above(0);

void begin_fabric(Material& material)
{
    material.fabric.used = true;
    material.stretch_stiffness = 0; // what a file says beside it is read later, and refused
}

void read_fabric(const Field& material, Material& out)
{
    const auto fabric = material.find("fabric");
    if (!fabric)
        return;
    begin_fabric(out);
    const Field keys = read_table(*fabric, kFabricTable, &out.fabric);
    if (const auto name = keys.find("preset"); name && !material.find("density"))
        if (const FabricPreset* preset = find_fabric_preset(name->text()))
            out.density = preset->density;
    apply_readings(out.fabric, out.density);
}
bool has_fabric(const Material& material) { return material.fabric.used; }

constexpr Key kMaterial[] = {
    kDensity.unit("kg/m^2"),
    object<&Material::fabric>("fabric",
                              "woven cloth by the moduli of its yarns, in place of springs along the "
                              "edges; under xpbd, mass_spring, implicit_euler and vbd",
                              kFabricTable)
        .when<has_fabric>()
        .reads<read_fabric>(),
    key<&Material::stretch_stiffness>("stretch_stiffness",
                                      "membrane stiffness, Young's modulus times thickness; \"rigid\": no "
                                      "compliance; 0: no stretch effect")
        .unit("N/m")
        .at_least(0)
        .or_word("rigid", kUnbounded),
    key<&Material::bending_stiffness>("bending_stiffness", "plate rigidity; 0: no bending effect")
        .unit("N m")
        .at_least(0),
    key<&Material::bending_model>("bending_model",
                                  "hinges that know nothing of each other, or hinges coupled within "
                                  "triangles, which converge to a plate; under xpbd")
        .see("plate", "effects/plate.md"),
    key<&Material::bending_poissons_ratio>("bending_poissons_ratio",
                                           "of a plate: how far it curves across where it is bent")
        .above(-1)
        .below(1),
    kThickness,
    key<&Material::stretch_damping>("stretch_damping", "a spring of stiffness k has a damper of k times this")
        .unit("s")
        .at_least(0),
    key<&Material::strain_limit>("strain_limit",
                                 "no spring becomes longer than (1 + this) of its rest length; "
                                 "0: no strain_limit effect")
        .unit("(of the rest length)")
        .at_least(0),
    kSlack,
    key<&Material::tear_strain>("tear_strain", "cloth tears where a spring is stretched by this share; 0: no "
                                               "tearing effect; not with a network, `springs` or a chain")
        .unit("(of the rest length)")
        .at_least(0),
    key<&Material::drag>("drag", "of triangles along their normal in the wind; 0: no wind effect")
        .unit("(a coefficient)")
        .at_least(0),
    kFrictionDrag,
    key<&Material::volume_stiffness>(
        "volume_stiffness", "a closed surface holds the volume within it by this bulk modulus; \"rigid\": no "
                            "compliance; 0: no surface_volume effect; not with `tear_strain`")
        .unit("Pa")
        .at_least(0)
        .or_word("rigid", kUnbounded)
        .see("surface_volume", "effects/surface_volume.md"),
    kPressure,
    kPressureLaw,
    key<&Material::plastic_yield>("plastic_yield", "strain of springs beyond which a part of it stays; 0: no "
                                                   "plasticity effect; under xpbd, vbd, implicit_euler and "
                                                   "mass_spring; not with `tear_strain`")
        .unit("(a strain)")
        .at_least(0)
        .see("plasticity", "effects/plasticity.md"),
    kCreep,
    kPlasticLimit,
};

constexpr Key kSolidMaterial[] = {
    kDensity.saying("mass of a volume").unit("kg/m^3"),
    key<&Material::youngs_modulus>("youngs_modulus", "stiffness").unit("Pa").above(0),
    key<&Material::poissons_ratio>("poissons_ratio", "how far it gives way across")
        .above(-1)
        .below(0.5)
        .because("0.5 is incompressible: take model \"springs\" with volume_stiffness \"rigid\""),
    key<&Material::model>("model",
                          "stable neo-Hookean tetrahedra, with or without the logarithm that keeps them "
                          "from collapsing to a point, or springs along the edges with constraints of "
                          "volume")
        .see("solids.md", "solids.md"),
    key<&Material::volume_stiffness>(
        "volume_stiffness",
        "springs: bulk modulus of the constraints of volume; \"rigid\": no compliance; 0: no "
        "volume effect; left out: that of `youngs_modulus` and `poissons_ratio`")
        .unit("Pa")
        .at_least(0)
        .or_word("rigid", kUnbounded)
        .unset_as(kBulkModulus)
        .usually("E / (3 (1 - 2 nu))"),
    key<&Material::volume>("volume",
                           "springs: what the constraints hold, the volume of each tetrahedron or the "
                           "one within the surface")
        .see("surface_volume", "effects/surface_volume.md"),
    key<&Material::bending_stiffness>("bending_stiffness", "of the surface, as a plate; 0: no bending effect")
        .unit("N m")
        .at_least(0),
    kThickness,
    key<&Material::stretch_damping>("stretch_damping",
                                    "springs: one of stiffness k has a damper of k times this")
        .unit("s")
        .at_least(0),
    key<&Material::strain_limit>("strain_limit", "springs: none becomes longer than (1 + this) of its rest "
                                                 "length; 0: no strain_limit effect")
        .unit("(of the rest length)")
        .at_least(0),
    kSlack,
    key<&Material::drag>("drag",
                         "of the surface's triangles along their normal in the wind; 0: no wind effect")
        .unit("(a coefficient)")
        .at_least(0),
    kFrictionDrag,
    kPressure.saying(
        "a closed surface encloses a gas that presses by this more than the air outside at the rest "
        "volume; negative: it sucks; 0: no pressure effect"),
    kPressureLaw,
    key<&Material::plastic_yield>("plastic_yield",
                                  "strain of springs and tetrahedra beyond which a part of it "
                                  "stays; 0: no plasticity effect; under xpbd, vbd, "
                                  "implicit_euler and mass_spring")
        .unit("(a strain)")
        .at_least(0)
        .see("plasticity", "effects/plasticity.md"),
    kCreep,
    kPlasticLimit,
};

constexpr std::string_view kAsCloth =
    "cloth is as stiff as \"stretch_stiffness\" (N/m) and \"bending_stiffness\" (N m) say";
constexpr Stranger kSolidKeys[] = {{"youngs_modulus", kAsCloth}, {"poissons_ratio", kAsCloth}};
constexpr Stranger kClothKeys[] = {
    {"stretch_stiffness", "a solid is as stiff as \"youngs_modulus\" (Pa) and \"poissons_ratio\" say"},
    {"tear_strain", "solids do not tear"},
    {"fabric", "a solid is as stiff as \"youngs_modulus\" (Pa) and \"poissons_ratio\" say"},
};

void begin_solid(Material& material) { material = solid_material(); }

} // namespace

constinit const TableOf<Material> kMaterialTable =
    TableOf<Material>("material", kMaterial).strange(kSolidKeys).checks<check_cloth>();
constinit const TableOf<Material> kSolidMaterialTable = TableOf<Material>("solid material", kSolidMaterial)
                                                            .strange(kClothKeys)
                                                            .begins<begin_solid>()
                                                            .checks<check_solid>();

} // namespace taut::scene_file
