#include "taut/world/start_moves.hpp"

#include "taut/world/start_ways.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace taut {
namespace {

constexpr std::uint32_t kWholeRounds = 500;  ///< in which wholes part, each in its own shape
constexpr double kStrain = 1e-5;             ///< of lengths: less is good enough
constexpr std::uint32_t kShapeSweeps = 10;   ///< a round, over all lengths
constexpr double kStep = 0.1;                ///< a round, of the length of the edge that crosses
constexpr double kBeyond = 1.002;            ///< of the gap, so that rounding does not fall short of it

/// What an edge that crosses has to go in a round, m.
glm::dvec3 step_of(const judging::CrossingEdge& c, const StartWays& ways, const StartSurfaces& surfaces,
                   const std::vector<glm::dvec3>& x)
{
    const judging::Edge& edge = surfaces.surface().edges[c.edge];
    return kStep * glm::distance(x[edge[0]], x[edge[1]]) * ways.way(c);
}

/// m: by how much two are too near.
double missing(const NearPair& pair) { return kBeyond * pair.gap - pair.distance; }

/// How long rounds go on that bring nothing.
class Patience
{
public:
    explicit Patience(std::uint32_t rounds) : rounds_(rounds) {}

    /// Records the number of crossings at the begin of a round. Returns false once it has not fallen for
    /// so many rounds.
    bool after(std::size_t crossings)
    {
        if (crossings < least_)
            least_ = crossings, since_ = 0;
        return since_++ < rounds_;
    }

private:
    std::uint32_t rounds_;
    std::size_t least_ = std::numeric_limits<std::size_t>::max();
    std::uint32_t since_ = 0;
};

/// A whole is what hangs together by lengths: it moves as a rigid body, without turning, where nothing of it
/// is held. (A piece, in start_ways.hpp, is what crossings cut off.)
class RigidWholes
{
public:
    RigidWholes(const StartSurfaces& surfaces, std::span<const double> inverse_mass,
                std::span<const StartLength> lengths);

    /// Moves `x` until two wholes neither cross nor are too near. False, and `x` as it was, where that does
    /// not end.
    bool part(std::vector<glm::dvec3>& x);

private:
    struct Whole
    {
        double mass = 0; ///< kg; infinite where a vertex stays
        glm::dvec3 way{0};
        double farthest = 0; ///< m: of the ways that `way` is the sum of
    };
    bool push(std::uint32_t a, std::uint32_t b, const glm::dvec3& way);
    void move(std::vector<glm::dvec3>& x);

    const StartSurfaces& surfaces_;
    std::vector<std::uint32_t> whole_of_; ///< per vertex
    std::vector<Whole> wholes_;
};

RigidWholes::RigidWholes(const StartSurfaces& surfaces, std::span<const double> inverse_mass,
                         std::span<const StartLength> lengths)
    : surfaces_(surfaces),
      wholes_(inverse_mass.size())
{
    Joined joined(inverse_mass.size());
    for (const StartLength& l : lengths)
        joined.join(l.a, l.b);
    whole_of_ = joined.roots();
    for (std::size_t v = 0; v < inverse_mass.size(); ++v)
        wholes_[whole_of_[v]].mass += 1 / inverse_mass[v]; // infinite where it is 0
}

/// `way` of the vertex a relative to b, shared by mass. False where neither whole can go, or both are one.
bool RigidWholes::push(std::uint32_t a, std::uint32_t b, const glm::dvec3& way)
{
    Whole &first = wholes_[whole_of_[a]], &second = wholes_[whole_of_[b]];
    const bool held = std::isinf(first.mass), other_held = std::isinf(second.mass);
    if (&first == &second || (held && other_held))
        return false;
    const double share = other_held ? 1 : held ? 0 : second.mass / (first.mass + second.mass);
    first.way += share * way;
    second.way -= (1 - share) * way;
    first.farthest = std::max(first.farthest, share * glm::length(way));
    second.farthest = std::max(second.farthest, (1 - share) * glm::length(way));
    return true;
}

void RigidWholes::move(std::vector<glm::dvec3>& x)
{
    for (std::size_t v = 0; v < x.size(); ++v)
    {
        const Whole& whole = wholes_[whole_of_[v]];
        if (const double size = glm::length(whole.way); size > 0)
            x[v] += std::min(1.0, whole.farthest / size) * whole.way;
    }
    for (Whole& whole : wholes_)
        whole.way = glm::dvec3(0), whole.farthest = 0;
}

bool RigidWholes::part(std::vector<glm::dvec3>& x)
{
    const std::vector<glm::dvec3> before = x;
    Patience patience(StartRounds().patience);
    for (std::uint32_t round = 0; round < kWholeRounds; ++round)
    {
        bool pushed = false;
        const auto crossed = surfaces_.crossings(x);
        const StartWays ways(surfaces_, x, crossed);
        for (const judging::CrossingEdge& c : crossed)
            pushed = push(surfaces_.surface().edges[c.edge][0], surfaces_.surface().triangles[c.triangle][0],
                          step_of(c, ways, surfaces_, x)) ||
                     pushed;
        if (!pushed) // what is near may be on the wrong side before
            for (const NearPair& pair : surfaces_.near(x))
                pushed = push(pair.corner[0], pair.corner[3], missing(pair) * pair.normal) || pushed;
        if (!pushed)
            return true;
        if (!patience.after(crossed.size()))
            break;
        move(x);
    }
    x = before;
    return false;
}

/// Everything that is not held goes, and keeps its lengths as well as it can.
class SingleVertices
{
public:
    SingleVertices(const StartSurfaces& surfaces, std::vector<double> inverse_mass,
                   std::vector<StartLength> lengths)
        : surfaces_(surfaces),
          w_(std::move(inverse_mass)),
          lengths_(std::move(lengths)),
          pushed_(w_.size())
    {
        std::erase_if(lengths_, [&](const StartLength& l) { return !(w_[l.a] + w_[l.b] > 0); });
    }

    /// False where something crosses still.
    bool part(std::vector<glm::dvec3>& x, const StartRounds& rounds);

private:
    struct Pushed
    {
        glm::dvec3 way{0};
        std::uint32_t count = 0;
        bool crosses = false;
    };
    void push(std::uint32_t vertex, const glm::dvec3& way);
    void push_crossings(std::span<const judging::CrossingEdge> crossed, const std::vector<glm::dvec3>& x);
    double push_crossing(const judging::CrossingEdge& c, const glm::dvec3& way);
    void push_near(const NearPair& pair);
    bool move(std::vector<glm::dvec3>& x);
    void keep_lengths(std::vector<glm::dvec3>& x) const;
    double largest_strain(const std::vector<glm::dvec3>& x) const;

    const StartSurfaces& surfaces_;
    std::vector<double> w_; ///< 1/kg; 0 = stays
    std::vector<StartLength> lengths_;
    std::vector<Pushed> pushed_; ///< per vertex, in this round
};

void SingleVertices::push(std::uint32_t vertex, const glm::dvec3& way)
{
    if (!(w_[vertex] > 0))
        return;
    pushed_[vertex].way += way;
    ++pushed_[vertex].count;
}

/// Returns the share of the way that the edge goes; the triangle goes the rest, against it.
double SingleVertices::push_crossing(const judging::CrossingEdge& c, const glm::dvec3& way)
{
    const judging::Edge& edge = surfaces_.surface().edges[c.edge];
    const judging::Triangle& triangle = surfaces_.surface().triangles[c.triangle];
    const double own = w_[edge[0]] + w_[edge[1]];
    const double other = w_[triangle[0]] + w_[triangle[1]] + w_[triangle[2]];
    const double share = own + other > 0 ? own / (own + other) : 0;
    for (const std::uint32_t v : edge)
        push(v, share * way);
    for (const std::uint32_t v : triangle)
        push(v, (share - 1) * way);
    for (const std::uint32_t v : edge)
        pushed_[v].crosses = true;
    for (const std::uint32_t v : triangle)
        pushed_[v].crosses = true;
    return share;
}

/// A piece that is cut off follows its edges.
void SingleVertices::push_crossings(std::span<const judging::CrossingEdge> crossed,
                                    const std::vector<glm::dvec3>& x)
{
    const StartWays ways(surfaces_, x, crossed);
    std::vector<Pushed> pieces(x.size());
    for (const judging::CrossingEdge& c : crossed)
    {
        const glm::dvec3 way = step_of(c, ways, surfaces_, x);
        const double share = push_crossing(c, way);
        if (const auto piece = ways.cut_off(c))
        {
            pieces[*piece].way += share * way;
            ++pieces[*piece].count;
        }
    }
    for (std::uint32_t v = 0; v < x.size(); ++v)
        if (const Pushed& piece = pieces[ways.piece_of(v)]; piece.count > 0 && pushed_[v].count == 0)
            push(v, piece.way / static_cast<double>(piece.count));
}

void SingleVertices::push_near(const NearPair& pair)
{
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k)
    {
        if (pushed_[pair.corner[k]].crosses) // it may be on the wrong side
            return;
        sum += w_[pair.corner[k]] * pair.weight[k] * pair.weight[k];
    }
    for (std::size_t k = 0; k < 4 && sum > 0; ++k)
        push(pair.corner[k], w_[pair.corner[k]] * pair.weight[k] * missing(pair) / sum * pair.normal);
}

/// False where nothing that was pushed can go.
bool SingleVertices::move(std::vector<glm::dvec3>& x)
{
    bool moved = false;
    for (std::size_t v = 0; v < x.size(); ++v)
    {
        if (pushed_[v].count > 0)
        {
            x[v] += pushed_[v].way / static_cast<double>(pushed_[v].count);
            moved = true;
        }
        pushed_[v] = {};
    }
    return moved;
}

void SingleVertices::keep_lengths(std::vector<glm::dvec3>& x) const
{
    for (const StartLength& l : lengths_)
    {
        const glm::dvec3 way = x[l.b] - x[l.a];
        const double now = glm::length(way);
        if (!(now > 0))
            continue;
        const glm::dvec3 part = (now - l.length) / (now * (w_[l.a] + w_[l.b])) * way;
        x[l.a] += w_[l.a] * part;
        x[l.b] -= w_[l.b] * part;
    }
}

double SingleVertices::largest_strain(const std::vector<glm::dvec3>& x) const
{
    double out = 0;
    for (const StartLength& l : lengths_)
        if (l.length > 0)
            out = std::max(out, std::abs(glm::distance(x[l.a], x[l.b]) - l.length) / l.length);
    return out;
}

bool SingleVertices::part(std::vector<glm::dvec3>& x, const StartRounds& rounds)
{
    std::uint32_t crossing = 0, finishing = 0;
    Patience patience(rounds.patience);
    while (crossing < rounds.most && finishing < rounds.finish)
    {
        const auto crossed = surfaces_.crossings(x);
        const auto near = surfaces_.near(x);
        if (crossed.empty() && near.empty() && largest_strain(x) < kStrain)
            return true;
        if (!crossed.empty() && !patience.after(crossed.size()))
            return false;
        push_crossings(crossed, x);
        for (const NearPair& pair : near)
            push_near(pair);
        if (!move(x) && !crossed.empty())
            return false;
        for (std::uint32_t sweep = 0; sweep < kShapeSweeps; ++sweep)
            keep_lengths(x);
        ++(crossed.empty() ? finishing : crossing);
    }
    return surfaces_.crossings(x).empty();
}

} // namespace

bool part_whole(const StartSurfaces& surfaces, std::span<const double> inverse_mass,
                std::span<const StartLength> lengths, std::vector<glm::dvec3>& x)
{
    return RigidWholes(surfaces, inverse_mass, lengths).part(x);
}

bool part_vertices(const StartSurfaces& surfaces, std::vector<double> inverse_mass,
                   std::vector<StartLength> lengths, std::vector<glm::dvec3>& x, const StartRounds& rounds)
{
    return SingleVertices(surfaces, std::move(inverse_mass), std::move(lengths)).part(x, rounds);
}

} // namespace taut
