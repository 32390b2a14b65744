// Second derivatives of elements by their energy: those of a membrane against differences of its forces.

#include "support/catch.hpp"
#include "support/symmetric.hpp"

#include "taut/report/added_stiffness.hpp"
#include "taut/report/positive_part.hpp"
#include "taut/report/static_energy.hpp"

#include <cmath>

using namespace taut;

namespace {

Scene membrane(const std::string& bending_model = "hinge")
{
    Scene scene;
    Body body;
    body.shape.cells = {2, 2};
    body.material.stretch_stiffness = 0;
    body.material.fabric.used = true;
    body.material.fabric.warp = 2000;
    body.material.fabric.weft = 1000;
    body.material.fabric.shear = 100;
    body.material.fabric.poissons_ratio = 0.3;
    body.material.bending_model = option_named<BendingModel>(bending_model);
    body.material.bending_stiffness = 1;
    scene.bodies = {body};
    return resolve(scene);
}

/// Strained by some tenths, squeezed along one axis, and bent.
std::vector<glm::dvec3> strained(std::vector<glm::dvec3> x)
{
    for (glm::dvec3& p : x)
        p = {1.2 * p.x + 0.1 * p.y, 0.8 * p.y, 0.3 * p.x * p.x + 0.2 * std::sin(3 * p.y)};
    return x;
}

} // namespace

TEST_CASE("a membrane's stiffness is how its forces change", "[residuals]")
{
    const PhysicalModel model = make_model(membrane());
    REQUIRE(model.added.size() == 8);
    const std::vector<glm::dvec3> x = strained(model.start);
    for (const AddedElement& e : model.added)
    {
        const Eigen::MatrixXd k = reference::added_stiffness(e, x);
        REQUIRE(k.rows() == 9);
        constexpr double kWay = 1e-4;
        for (int r = 0; r < 9; ++r)
        {
            std::vector<glm::dvec3> ahead = x, behind = x;
            ahead[e.vertex[static_cast<std::size_t>(r / 3)]][r % 3] += kWay;
            behind[e.vertex[static_cast<std::size_t>(r / 3)]][r % 3] -= kWay;
            const auto more = e.forces(ahead), less = e.forces(behind);
            for (int s = 0; s < 9; ++s)
            {
                const auto c = static_cast<std::size_t>(s / 3);
                const double slope = -(more[c][s % 3] - less[c][s % 3]) / (2 * kWay);
                CHECK(k(s, r) == Approx(slope).margin(1e-6 * k.norm()));
            }
        }
        const Eigen::MatrixXd kept = reference::positive_part(k);
        const Eigen::VectorXd before = symmetric_eigenvalues(k);
        const Eigen::VectorXd after = symmetric_eigenvalues(kept);
        CHECK(before[0] < -1e-3 * k.norm()); // it is squeezed
        CHECK((after - before.cwiseMax(0)).norm() < 1e-9 * k.norm());
    }
}

TEST_CASE("an element whose corners are in one place has no stiffness", "[residuals]")
{
    const PhysicalModel model = make_model(membrane());
    const std::vector<glm::dvec3> nowhere(model.start.size(), glm::dvec3(1, 2, 3));
    CHECK(reference::added_stiffness(model.added[0], nowhere).norm() == 0);
}

TEST_CASE("a model's stiffness has its membranes and its plates", "[residuals]")
{
    const auto along = [](const PhysicalModel& model, const glm::dvec3& way) { // J/m^2: w^T K w
        reference::State x;
        for (const glm::dvec3& p : model.start)
            x.push_back({p.x, p.y, p.z});
        const reference::StaticEnergy energy(model);
        const Eigen::SparseMatrix<double> k = energy.hessian(x, reference::Curvature::projected, 0);
        Eigen::VectorXd w = Eigen::VectorXd::Zero(energy.unknowns());
        for (std::size_t i = 0; i < model.start.size(); ++i)
            for (int c = 0; c < 3; ++c) // quadratic in the place: it strains, or it curves
                w[energy.unknown(i) + c] = way[c] * model.start[i].x * model.start[i].x;
        const Eigen::VectorXd image = k.selfadjointView<Eigen::Lower>() * w;
        return w.dot(image);
    };
    const PhysicalModel both = make_model(membrane("plate"));
    REQUIRE(both.plates.size() == 8);
    PhysicalModel no_plates = both, no_membranes = both;
    no_plates.plates.clear();
    no_membranes.added.clear();
    CHECK(along(both, {1, 0, 0}) > 100);
    CHECK(along(both, {0, 0, 1}) > 0.1);
    CHECK(along(no_plates, {0, 0, 1}) < 1e-4); // differences of energies are off by that
    CHECK(along(no_membranes, {1, 0, 0}) < 1e-6);
    CHECK(along(no_membranes, {0, 0, 1}) == Approx(along(both, {0, 0, 1})).epsilon(1e-3));
}
