#include "taut/kernels/collide_distance_field.hpp"

#include "support/box_distance.hpp"
#include "support/turned.hpp"

#include <functional>

using namespace taut;
using namespace taut::conformance;
using kernels::collide_distance_field::Params;

namespace {

template <typename Real>
using Record = layout::DistanceFieldCollider<Real>;

/// A grid and what it holds.
struct Grid
{
    glm::uvec3 points{0};
    glm::dvec3 low{0};
    double cell = 0;
    std::vector<double> values; ///< as the kernel gets them: rounded

    double value(const glm::ivec3& at) const
    {
        const auto u = glm::uvec3(at);
        return values[u.x + points.x * (u.y + points.y * u.z)];
    }

    /// The eight points round a place, each by the volume across from it; from beyond the grid by Pythagoras.
    double distance(const glm::dvec3& p) const
    {
        const glm::dvec3 at = (p - low) / cell;
        const glm::dvec3 q = glm::clamp(at, glm::dvec3(0), glm::dvec3(points) - 1.0);
        const glm::ivec3 first = glm::min(glm::ivec3(glm::floor(q)), glm::ivec3(points) - 2);
        const glm::dvec3 share = q - glm::dvec3(first);
        double sum = 0;
        for (int corner = 0; corner < 8; ++corner)
        {
            const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
            double part = 1;
            for (int axis = 0; axis < 3; ++axis)
                part *= side[axis] == 1 ? share[axis] : 1 - share[axis];
            sum += part * value(first + side);
        }
        const double off = glm::length(at - q) * cell;
        return off > 0 ? std::hypot(off, sum) : sum;
    }

    /// By what it changes over a cell along each axis; its size comes back in `slope`.
    glm::dvec3 normal(const glm::dvec3& p, double& slope) const
    {
        glm::dvec3 change(0);
        for (int axis = 0; axis < 3; ++axis)
        {
            glm::dvec3 step(0);
            step[axis] = cell / 2;
            change[axis] = distance(p + step) - distance(p - step);
        }
        slope = glm::length(change) / cell;
        return slope > 0 ? glm::normalize(change) : glm::dvec3(0, 1, 0);
    }
};

template <typename Real>
Grid make_grid(const glm::uvec3& points, const glm::dvec3& low, double cell,
               const std::function<double(const glm::dvec3&)>& distance)
{
    Grid out{points, glm::dvec3(glm::vec<3, Real>(low)), static_cast<double>(static_cast<Real>(cell)), {}};
    for (unsigned k = 0; k < points.z; ++k)
        for (unsigned j = 0; j < points.y; ++j)
            for (unsigned i = 0; i < points.x; ++i)
                out.values.push_back(static_cast<double>(
                    static_cast<Real>(distance(out.low + out.cell * glm::dvec3(i, j, k)))));
    return out;
}

template <typename Real>
Record<Real> record_of(const Frame& frame, const Grid& grid, std::size_t first, double friction)
{
    Record<Real> c{};
    put_frame<Real>(c, frame);
    c.low_x = static_cast<Real>(grid.low.x);
    c.low_y = static_cast<Real>(grid.low.y);
    c.low_z = static_cast<Real>(grid.low.z);
    c.cell = static_cast<Real>(grid.cell);
    c.friction = static_cast<Real>(friction);
    c.count_x = grid.points.x;
    c.count_y = grid.points.y;
    c.count_z = grid.points.z;
    c.first = static_cast<std::uint32_t>(first);
    return c;
}

struct Entry
{
    double time = 2; ///< 2: never
    bool doubtful = false;
};

/// The first time at which a way is not above 0, looked for in 1,000 places. Doubtful where it hardly dips
/// below, or leaves again sooner than the kernel promises to notice.
Entry entry_of(const std::function<double(double)>& height, double rounding)
{
    constexpr int kPlaces = 1000;
    Entry out;
    int in = 0;
    double deepest = 0, last = height(0);
    bool falls = false;
    for (int n = 1; n <= kPlaces && !out.doubtful; ++n)
    {
        const double now = height(n / double(kPlaces));
        if (in == 0 && now > 0)
            out.doubtful = falls && now > last && last < rounding;
        if (in == 0 && now <= 0)
            in = n;
        deepest = std::min(deepest, in > 0 ? now : 0.0);
        if (in > 0 && now > 0 && n - in < kPlaces / 32 + 2)
            out.doubtful = true;
        falls = now < last;
        last = now;
    }
    if (in == 0)
        return out;
    out.doubtful = out.doubtful || -deepest < 4 * rounding;
    double before = (in - 1) / double(kPlaces), after = in / double(kPlaces);
    for (int n = 0; n < 60; ++n)
    {
        const double middle = (before + after) / 2;
        (height(middle) > 0 ? before : after) = middle;
    }
    out.time = before;
    return out;
}

template <typename Real>
struct Shapes
{
    std::vector<Grid> grids; ///< one a collider
    std::vector<Record<Real>> poses;
};

template <typename Real>
Touch touch_field(const Shapes<Real>& shapes, const Contacts<Real>& in, std::uint32_t j, const glm::dvec3& x,
                  const glm::dvec3& d, double kept)
{
    const Grid& grid = shapes.grids[j];
    const Way way = way_of(shapes.poses, in, j, x, d);
    const double before = grid.distance(way.a) - kept, after = grid.distance(way.e) - kept;
    const double rounding = 64 * std::numeric_limits<Real>::epsilon() * (way.terms + 2);
    double slope = 1;
    glm::dvec3 own(0, 1, 0);
    const double reach = std::min(before, after) - way.length() - grid.cell;
    bool doubtful = std::abs(reach) < rounding || std::abs(before) < rounding ||
                    std::abs(way.length() - grid.cell / 2) < rounding;
    Touch t;
    t.gap_before = before;
    t.gap = after;
    double way_terms = 0;
    if (reach < 0)
        own = grid.normal(before > 0 ? way.e : way.a, slope);
    if (reach < 0 && before <= 0)
        t.gap = before + glm::dot(own, way.e - way.a);
    else if (reach < 0 && way.length() > grid.cell / 2)
    {
        const Entry entry =
            entry_of([&](double time) { return grid.distance(way.at(time)) - kept; }, rounding);
        const glm::dvec3 meets = way.at(std::min(entry.time, 1.0));
        double slope_there = 1;
        const glm::dvec3 first = grid.normal(meets, slope_there);
        const bool in_doubt = entry.doubtful || std::abs(glm::dot(first, own) - 0.3) < 1e-3;
        doubtful = doubtful || in_doubt || (entry.time <= 1 && std::abs(after) < rounding);
        if (entry.time <= 1 && (after >= 0 || glm::dot(first, own) <= 0.3))
        {
            own = first;
            t.gap = glm::dot(first, way.e - meets);
            slope = slope_there;
            // A later entry by u of the way is u |e - a|: by how steeply it goes in.
            const double steep = std::abs(glm::dot(first, way.e - way.a)) / way.length();
            way_terms = way.length() / std::max(steep, 1e-3);
            doubtful = doubtful || steep < 0.02;
        }
    }
    t.normal = way.end.turned(own);
    t.friction = static_cast<double>(shapes.poses[j].friction);
    add_slide(t, way, d);
    doubtful = doubtful || slope < 0.1; // near the middle of the shape
    t.size = doubtful
                 ? kAnyFinite
                 : (way.terms + 2 + way_terms) * (2 + (std::abs(t.gap) + way.length()) / (grid.cell * slope));
    return t;
}

template <typename Real>
void check_fields(const Contacts<Real>& in, const Shapes<Real>& shapes, const std::string& variant,
                  bool first_iteration, bool report)
{
    const KernelInfo& kernel = kernels::collide_distance_field::info(variant, precision_of<Real>());
    const Params params{in.count, in.colliders, in.substep, in.substeps, first_iteration, report};
    const Rules rules{variant != "", variant == "friction_kept", first_iteration, 0};
    Buffers buffers = in.buffers("collider", shapes.poses);
    std::vector<Real> values;
    for (const Grid& grid : shapes.grids)
        for (const double value : grid.values)
            values.push_back(static_cast<Real>(value));
    if (values.empty())
        values.push_back(0);
    buffers["values"] = bytes_of(values);
    check_contacts(in, kernel, bytes_of(std::vector{params}), buffers, rules, report,
                   [&](const glm::dvec3& x, const glm::dvec3& d, double kept, std::uint32_t j) {
                       return touch_field(shapes, in, j, x, d, kept);
                   });
}

double ball(const glm::dvec3& p) { return glm::length(p) - 0.5; }

double box(const glm::dvec3& p) { return test::box_distance(p, {0.4, 0.3, 0.5}); }

double torus(const glm::dvec3& p) { return std::hypot(std::hypot(p.x, p.z) - 0.5, p.y) - 0.2; }

/// Around the first, a ball of half a metre at the origin.
template <typename Real>
void plant(Contacts<Real>& in)
{
    const auto put = [&](std::uint32_t i, glm::dvec3 x, double w, glm::dvec3 d) {
        if (i >= in.count)
            return;
        in.position[i] = {glm::vec<3, Real>(x), static_cast<Real>(w)};
        in.delta[i] = {glm::vec<3, Real>(d), Real(0)};
    };
    put(0, {0.55, 0.25, 0}, 1, {-0.125, 0, 0}); // into it, and it stays on its side
    put(1, {0.3, 0.2, 0.1}, 0, {0, 0, 0});      // held inside: a conflict
    put(2, {-2, 0.1, 0.05}, 1, {4, 0, 0});      // through it
    put(3, {-2, 2, 0}, 1, {4, 0, 0});           // passes by
    put(4, {-2, 0.1, 0}, 1, {2.25, 0, 0});      // stops inside, past the middle
    put(5, {0.3, 0.1, 0.1}, 1, {0.0625, 0, 0}); // inside from the start: limited way out
    put(6, {-30, 0.1, 0}, 1, {60, 0, 0});       // very fast, from beyond the grid
    put(7, {3, 4, 5}, 1, {0, 0, 0});            // at rest beyond the grid
}

} // namespace

TEMPLATE_TEST_CASE(
    "vertices end outside every distance field, swept, and friction takes sliding up to its cone",
    "[distance_field]", float, double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "friction", "friction_kept");
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::uint32_t colliders = GENERATE(1u, 3u);
    const bool first_iteration = GENERATE(true, false), report = GENERATE(true, false);
    const double speed = GENERATE(0.1, 2.0);
    const std::uint64_t seed = 5300 + count;
    CAPTURE(variant, count, colliders, first_iteration, report, speed, seed);
    Random random(seed);
    auto in = random_contacts<Real>(random, count, colliders, 1.2, speed);
    in.substeps = 4;
    in.substep = count % 4;
    Shapes<Real> shapes;
    shapes.poses.resize((in.substeps + 1) * colliders);
    std::size_t first = 0;
    for (std::uint32_t j = 0; j < colliders; ++j)
    {
        const auto& distance = j == 0 ? ball : j == 1 ? box : torus;
        shapes.grids.push_back(make_grid<Real>({17 + j, 18, 19}, {-0.9, -0.85, -0.91}, 0.1, distance));
        const Drift drift = random_drift(random);
        const double friction = random.uniform(0, 1);
        for (std::uint32_t s = 0; s <= in.substeps; ++s)
            shapes.poses[s * colliders + j] =
                record_of<Real>(j == 0 ? Frame{} : drift.at(s),
                                shapes.grids[j], first, friction);
        first += shapes.grids[j].values.size();
    }
    plant(in);
    check_fields(in, shapes, variant, first_iteration, report);
}

TEMPLATE_TEST_CASE("no distance field changes nothing", "[distance_field]", float, double)
{
    using Real = TestType;
    Random random(5390);
    const auto in = random_contacts<Real>(random, 65, 0, 1, 0.3);
    check_fields<Real>(in, {{}, {record_of<Real>({}, make_grid<Real>({2, 2, 2}, {0, 0, 0}, 1, ball), 0, 0)}},
                       GENERATE("", "friction", "friction_kept"), true, true);
}

TEMPLATE_TEST_CASE("a vertex that is nowhere reads no value beyond the grid", "[distance_field]", float,
                   double)
{
    using Real = TestType;
    Contacts<Real> in;
    in.count = in.colliders = 1;
    const Real far = GENERATE(Real(1e30), -Real(1e30), std::numeric_limits<Real>::infinity(),
                              std::numeric_limits<Real>::quiet_NaN());
    in.position = {{far, Real(0), -far, Real(1)}};
    in.delta = {{Real(0), Real(0), Real(0), Real(0)}};
    const Grid grid = make_grid<Real>({3, 3, 3}, {-1, -1, -1}, 1, ball);
    Buffers buffers = in.buffers("collider", std::vector(2, record_of<Real>({}, grid, 0, 0)));
    buffers["values"] = bytes_of(std::vector<Real>(grid.values.begin(), grid.values.end()));
    const Launch launch = make_launch(kernels::collide_distance_field::info("", precision_of<Real>()),
                                      Params{1, 1, 0, 1, 1, 1}, 1);
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector);
        const auto delta = reals_of<Real>(run(*device, {launch}, buffers).at("delta"));
        if (std::abs(far) <= Real(1e30)) // too far to be met; what is nowhere ends nowhere
            CHECK(delta[0] == Real(0));
        CHECK(device->counters().validation_messages == 0);
    }
}
