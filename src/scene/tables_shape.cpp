// Keys of generated shapes.

#include "taut/scene/checker.hpp"
#include "taut/scene/tables.hpp"

namespace taut::scene_file {
namespace {

bool has_links(const Shape& shape) { return shape.links > 0; } // one particle has no length

void begin_network(SpringNetwork& network) { network.used = true; }

constexpr Key kGrid[] = {
    key<&Shape::cells>("cells", "their number along each side")
        .called("[columns, rows]")
        .at_least(1)
        .ranges("1 or more each; at most 67108864 vertices"),
    key<&Shape::size>("size", "its extent").called("[width, height]").unit("m").above(0),
    key<&Shape::diagonals>("diagonals", "how cells are cut: neighbours mirrored (union jack), or all alike"),
    object<&Shape::network>(
        "network", "springs between vertices instead of springs along the edges of triangles", kNetworkTable),
};

constexpr Key kNetwork[] = {
    key<&SpringNetwork::structural>("structural", "to the four neighbours along rows and columns")
        .unit("N/m")
        .at_least(0),
    key<&SpringNetwork::shear>("shear", "to the four diagonal neighbours").unit("N/m").at_least(0),
    key<&SpringNetwork::bend>("bend", "to the four second neighbours along rows and columns")
        .unit("N/m")
        .at_least(0),
};

constexpr Key kChain[] = {
    key<&Shape::links>("links", "their number; 0 is one free particle").at_most(kMaxVertices - 1),
    key<&Shape::length>("length", "of the whole chain").unit("m").above(0).when<has_links>(),
    key<&Shape::width>("width", "of the strip of cloth that the chain stands for (mass and stiffness follow "
                                "from it)")
        .unit("m")
        .above(0),
};

constexpr Key kSolidBox[] = {
    key<&Shape::box_cells>("cells", "their number along each axis")
        .called("[x, y, z]")
        .at_least(1)
        .ranges("1 or more each; at most 67108864 vertices"),
    key<&Shape::box_size>("size", "along x, y and z").unit("m").above(0),
    key<&Shape::split>("split", "tetrahedra of a cell: five, mirrored from cell to cell, or six round its "
                                "diagonal"),
};

constexpr Key kBall[] = {
    key<&Shape::ball_cells>("cells", "along a diameter")
        .at_least(2)
        .ranges("2 or more; at most 67108864 vertices"),
    key<&Shape::radius>("radius", "of its surface").unit("m").above(0),
};

} // namespace

constinit const TableOf<Shape> kGridTable = TableOf<Shape>("grid", kGrid).checks<check_grid>();
constinit const TableOf<SpringNetwork> kNetworkTable =
    TableOf<SpringNetwork>("network", kNetwork).begins<begin_network>();
constinit const TableOf<Shape> kChainTable("chain", kChain);
constinit const TableOf<Shape> kSolidBoxTable = TableOf<Shape>("solid box", kSolidBox).checks<check_box>();
constinit const TableOf<Shape> kBallTable = TableOf<Shape>("ball", kBall).checks<check_ball>();

} // namespace taut::scene_file
