#include "taut/plan/contact_patch.hpp"

#include "support/catch.hpp"
#include "taut/kernels/shared/contact_rows.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace {

using namespace taut;

/// Leaves of a surface, in the order of the tree.
struct Surface
{
    std::vector<glm::dvec3> rest;
    std::vector<ContactLeaf> leaves;

    /// Cells of a grid, each of two triangles, at the places that `at` gives to grid points; `has`: those
    /// that are there.
    void add(std::uint32_t nx, std::uint32_t ny, const std::function<glm::dvec3(double, double)>& at,
             const std::function<bool(std::uint32_t, std::uint32_t)>& has = {}, std::uint32_t body = 0)
    {
        const auto first = static_cast<std::uint32_t>(rest.size());
        for (std::uint32_t i = 0; i <= nx; ++i)
            for (std::uint32_t j = 0; j <= ny; ++j)
                rest.push_back(at(i, j));
        for (std::uint32_t i = 0; i < nx; ++i)
            for (std::uint32_t j = 0; j < ny; ++j)
            {
                const std::uint32_t v = first + i * (ny + 1) + j, w = v + ny + 1;
                if (has && !has(i, j))
                    continue;
                leaves.push_back({{v, w, v + 1}, body, 0});
                leaves.push_back({{w, w + 1, v + 1}, body, 0});
            }
    }

    /// How far up the patch of each leaf begins.
    std::vector<std::uint32_t> levels()
    {
        leaves = in_tree_order(std::move(leaves), rest);
        share_out(leaves);
        const std::vector<ContactLeaf> before = leaves;
        mark_patches(leaves, rest);
        std::vector<std::uint32_t> out;
        for (std::size_t k = 0; k < leaves.size(); ++k)
        {
            constexpr std::uint32_t own = (1u << TAUT_CONTACT_OWNS_PATCH) - 1;
            CHECK((leaves[k].owns & own) == before[k].owns); // what is its own stays
            out.push_back(leaves[k].owns >> TAUT_CONTACT_OWNS_PATCH);
        }
        return out;
    }
};

glm::dvec3 plane(double i, double j) { return {i, j, 0}; }

std::size_t count_of(const std::vector<std::uint32_t>& levels, std::uint32_t level)
{
    return static_cast<std::size_t>(std::count(levels.begin(), levels.end(), level));
}

} // namespace

TEST_CASE("a level sheet is one patch, and so is one that is bent by less than faces away")
{
    for (const double height : {0.0, 3.0})
    {
        Surface flat;
        flat.add(16, 16, [&](double i, double j) { return glm::dvec3(i, j, height * std::cos(i / 5)); });
        CHECK(count_of(flat.levels(), 9) == 512);
    }
    Surface small; // fewer triangles than a patch has
    small.add(2, 2, plane);
    CHECK(count_of(small.levels(), 0) == 8);
    Surface odd; // a tree that is not full
    odd.add(10, 9, plane);
    CHECK(count_of(odd.levels(), 0) < 60); // outlines of small nodes may be ragged
}

TEST_CASE("a closed tube and a sheet that is folded over are patches in parts only")
{
    Surface tube;
    tube.add(32, 8, [](double i, double j) {
        return glm::dvec3(5 * std::cos(i * 0.196349540849), 5 * std::sin(i * 0.196349540849), j);
    });
    const auto levels = tube.levels();
    CHECK(count_of(levels, 9) == 0);
    CHECK(count_of(levels, 8) == 0);
    CHECK(count_of(levels, 7) + count_of(levels, 6) + count_of(levels, 5) > 256);
    Surface fold;
    fold.add(16, 16,
             [](double i, double j) { return glm::dvec3(std::min(i, 16 - i), j, i > 8 ? 0.5 : 0.0); });
    CHECK(count_of(fold.levels(), 9) == 0);
}

TEST_CASE("sheets that lie on each other are no patch together, of one body or of two")
{
    const std::uint32_t other = GENERATE(0u, 1u);
    Surface two;
    two.add(8, 8, plane);
    two.add(
        8, 8, [](double i, double j) { return glm::dvec3(i, j, 0.1); }, {}, other);
    const auto levels = two.levels();
    CHECK(count_of(levels, 8) == 0);
}

TEST_CASE("a slit, a notch and a hole are in no patch, though a patch may end at them")
{
    const auto without = [](const std::function<bool(std::uint32_t, std::uint32_t)>& has) {
        Surface s;
        s.add(16, 16, plane, has);
        return s.levels();
    };
    const auto notch = without([](std::uint32_t i, std::uint32_t j) { return i != 8 || j > 7; });
    CHECK(*std::max_element(notch.begin(), notch.end()) < 9);
    CHECK(count_of(notch, 0) > 0);
    const auto hole = without([](std::uint32_t i, std::uint32_t j) { return i != 4 || j != 4; });
    CHECK(count_of(hole, 0) > 0);
    CHECK(*std::max_element(hole.begin(), hole.end()) < 9);
    Surface slit; // two sheets that share the vertices of half of a line
    slit.add(8, 16, plane);
    slit.add(8, 16, [](double i, double j) { return glm::dvec3(8 + i, j, 0); });
    for (ContactLeaf& leaf : slit.leaves)
        for (std::uint32_t& v : leaf.corner)
            if (v >= 153 && v < 153 + 9) // of the second, i = 0, j < 9
                v -= 17;
    const auto levels = slit.levels();
    CHECK(count_of(levels, 9) == 0);
    CHECK(count_of(levels, 0) > 0); // about the end of the slit
}

TEST_CASE("a ramp that winds above itself is no patch, though it faces one way")
{
    Surface ramp;
    ramp.add(64, 8, [](double i, double j) {
        const double turn = i * 0.15; // more than once round
        return glm::dvec3((2 + j) * std::cos(turn), (2 + j) * std::sin(turn), 0.1 * turn);
    });
    const auto levels = ramp.levels();
    CHECK(count_of(levels, 10) == 0);
    CHECK(count_of(levels, 9) == 0);
}

TEST_CASE("triangles that share a side with two others, or are without an area, are in no patch")
{
    Surface fins;
    fins.add(8, 8, plane);
    fins.rest.push_back({4.5, 4, 1});
    fins.leaves.push_back({{4 * 9 + 4, 5 * 9 + 4, 81}, 0, 0});
    const auto levels = fins.levels();
    CHECK(count_of(levels, 7) <= 1); // what is left for the other half of the tree
    Surface flat;
    flat.add(8, 8, [](double, double j) { return glm::dvec3(0, j, 0); });
    CHECK(count_of(flat.levels(), 0) == 128);
}
