// What a picture holds.

#include "support/catch.hpp"
#include "support/scenes.hpp"

#include "taut/report/picture.hpp"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

using namespace taut;

TEST_CASE("every vertex of every moment lies inside the picture")
{
    const Scene scene = test::everything(6);
    std::vector<PictureMoment> moments(2);
    for (const glm::dvec3& p : scene.bodies[0].mesh.positions)
    {
        moments[0].positions.push_back(p);
        moments[1].positions.push_back(3.0 * p + glm::dvec3(1, -7, 2));
    }
    moments[1].positions[3] = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    const Shot shot = frame_shot(scene, moments, 400, 300);
    const glm::mat4 view = glm::perspectiveRH_ZO(shot.camera.fov, 400.0f / 300.0f, 0.01f, 1000.0f) *
                           glm::lookAtRH(shot.camera.eye, shot.camera.target, shot.camera.up);
    float extreme = 0;
    for (const PictureMoment& moment : moments)
        for (const glm::dvec3& p : moment.positions)
        {
            if (std::isnan(p.x))
                continue;
            const glm::vec4 clip = view * glm::vec4(glm::vec3(p), 1);
            REQUIRE(clip.w > 0);
            extreme = std::max({extreme, std::abs(clip.x / clip.w), std::abs(clip.y / clip.w)});
            CHECK(glm::length(glm::vec3(p) - shot.focus) <= shot.radius);
        }
    CHECK(extreme < 1.0f);
    CHECK(extreme > 0.8f); // and the picture is not much larger than they need
}

TEST_CASE("scraps of torn cloth that fell far leave the picture, and what hangs from pins does not")
{
    Scene scene = test::hanging(8);
    scene.bodies[0].material.tear_strain = 0.2;
    Mesh& mesh = scene.bodies[0].mesh;
    const auto sheet = static_cast<std::uint32_t>(mesh.positions.size());
    for (const double x : {0.0, 0.1, 0.2}) // a triangle of its own
        mesh.positions.emplace_back(x, -0.8, x * x);
    mesh.triangles.push_back({sheet, sheet + 1, sheet + 2});
    const auto radius = [&](const Scene& of, double sheet_falls, double scrap_falls) {
        PictureMoment moment{0, mesh.positions, std::make_shared<const Scene>(of)};
        for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
            moment.positions[v].y -= v < sheet ? sheet_falls : scrap_falls;
        return double(frame_shot(of, std::span(&moment, 1), 400, 300).radius);
    };
    const double near = radius(scene, 0, 0);
    CHECK(near > 0.75); // the scrap is in it: half a metre of cloth to each side, and 0.3 below
    CHECK(radius(scene, 0, 40) < near);
    CHECK(radius(scene, 0, 40) == Approx(1.02 * std::sqrt(0.5))); // the sheet alone
    CHECK(radius(scene, 40, 0) == Approx(1.02 * std::sqrt(0.5))); // it holds the pins
    Scene loose = scene;
    loose.bodies[0].pins.clear();
    CHECK(radius(loose, 40, 0) == Approx(1.02 * std::sqrt(0.5))); // the larger part
    Scene whole = scene;
    whole.bodies[0].material.tear_strain = 0;
    CHECK(radius(whole, 0, 40) > 19); // what cannot tear is shown wherever it went
}
