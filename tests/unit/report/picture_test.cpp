#include "images.hpp"

#include "support/skip.hpp"
#include "support/devices.hpp"
#include "support/scenes.hpp"
#include "support/sphere.hpp"
#include "taut/scene/embedding.hpp"

#include "taut/report/picture.hpp"

#include <algorithm>
#include <cstdlib>

namespace {

using namespace taut;
using namespace taut::test;

/// Null, with a visible reason, where no Vulkan device draws.
std::shared_ptr<Device> drawing_device()
{
    const auto& known = test_devices();
    if (std::find(known.begin(), known.end(), "vulkan") != known.end() && can_draw(*test_device("vulkan")))
        return test_device("vulkan");
    TAUT_LEFT_OUT("no Vulkan device draws here");
    return nullptr;
}

#define TAUT_DRAWING(device)                                                                                 \
    const std::shared_ptr<taut::Device> device = drawing_device();                                           \
    if (!device)                                                                                             \
    return

#define CHECK_NOTHING_SAID(device) CHECK((device)->counters().validation_messages == 0)

glm::ivec3 centre(const Image& image) { return pixel(image, image.width / 2, image.height / 2); }

Shot small_shot()
{
    Shot shot;
    shot.width = 160;
    shot.height = 120;
    return shot;
}

/// A square of edge 2 at height z, its front towards +z.
Surface square(float z, const glm::vec3& front, const glm::vec3& back)
{
    Surface out;
    out.positions = {{-1, -1, z, 1}, {1, -1, z, 1}, {1, 1, z, 1}, {-1, 1, z, 1}};
    out.triangles = {0, 1, 2, 0, 2, 3};
    out.front = front;
    out.back = back;
    return out;
}

constexpr glm::vec3 kRed{0.8f, 0.1f, 0.1f}, kGreen{0.1f, 0.8f, 0.1f};

bool reddish(const glm::ivec3& p) { return p.r > 2 * p.g && p.r > 2 * p.b; }
bool greenish(const glm::ivec3& p) { return p.g > 2 * p.r && p.g > 2 * p.b; }

} // namespace

TEST_CASE("an empty scene shows the background and nothing else")
{
    TAUT_DRAWING(device);
    Renderer renderer(device);
    Shot shot = small_shot();
    shot.sky_top = {1, 0.5f, 0.25f};
    shot.sky_bottom = {0, 0.5f, 1};
    const Image image = renderer.draw(shot, {});
    REQUIRE(image.rgba.size() == 4u * 160 * 120);
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 1; x < image.width; ++x)
            REQUIRE(pixel(image, x, y) == pixel(image, 0, y));
    for (std::uint32_t y = 1; y < image.height; ++y)
    {
        CHECK(pixel(image, 0, y).r <= pixel(image, 0, y - 1).r);
        CHECK(pixel(image, 0, y).b >= pixel(image, 0, y - 1).b);
    }
    const glm::ivec3 top = pixel(image, 0, 0);
    CHECK(top.r >= 253);
    CHECK(std::abs(top.g - 128) <= 1);
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("a cloth covers the middle of a picture and leaves its corners alone")
{
    TAUT_DRAWING(device);
    Renderer renderer(device);
    Shot shot = small_shot();
    shot.camera.eye = {0, 0, 8};
    const Image empty = renderer.draw(shot, {});
    const Surface surfaces[] = {square(0, kRed, kGreen)};
    const Image image = renderer.draw(shot, surfaces);
    CHECK(reddish(centre(image)));
    for (const std::uint32_t x : {0u, 159u})
        for (const std::uint32_t y : {0u, 119u})
            CHECK(pixel(image, x, y) == pixel(empty, x, y));
    // 2 m at 8 m under an opening of 0.6 are 0.404 of the height: 48.5 pixels each way.
    const double edge = std::sqrt(double(differing(image, empty)));
    CHECK(edge == Approx(48.5).margin(1.5));
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("front and back of a cloth have colours of their own")
{
    TAUT_DRAWING(device);
    Renderer renderer(device);
    const Surface surfaces[] = {square(0, kRed, kGreen)};
    Shot shot = small_shot();
    CHECK(reddish(centre(renderer.draw(shot, surfaces))));
    shot.camera.eye.z = -5;
    CHECK(greenish(centre(renderer.draw(shot, surfaces))));
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("what is nearer hides what is further, in whatever order it is drawn")
{
    TAUT_DRAWING(device);
    Renderer renderer(device);
    Surface near = square(0.5f, kRed, kRed), far = square(-0.5f, kGreen, kGreen);
    const Surface forward[] = {near, far}, backward[] = {far, near};
    const Image a = renderer.draw(small_shot(), forward);
    CHECK(reddish(centre(a)));
    CHECK(differing(a, renderer.draw(small_shot(), backward)) == 0);
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("a body above the ground darkens ground that it does not cover")
{
    TAUT_DRAWING(device);
    Renderer renderer(device);
    Surface ground = square(-0.5f, glm::vec3(0.8f), glm::vec3(0.8f)), body = square(0.2f, kRed, kRed);
    ground.finish = Finish::ground;
    for (glm::vec4& p : ground.positions)
        p = {4 * p.x, 4 * p.y, p.z, 1};
    for (glm::vec4& p : body.positions)
        p = {0.2f * p.x, 0.2f * p.y, p.z, 1};
    Shot shot = small_shot();
    shot.camera.eye = {0, -3, 3};
    shot.camera.up = {0, 0, 1};
    const Surface alone[] = {ground}, both[] = {ground, body};
    const Image before = renderer.draw(shot, alone), after = renderer.draw(shot, both);
    int darker = 0, covered = 0;
    for (std::uint32_t y = 0; y < after.height; ++y)
        for (std::uint32_t x = 0; x < after.width; ++x)
        {
            covered += reddish(pixel(after, x, y)) ? 1 : 0;
            const glm::ivec3 change = pixel(before, x, y) - pixel(after, x, y);
            darker += change.r > 20 && change.g > 20 && change.b > 20 && !reddish(pixel(after, x, y)) ? 1 : 0;
        }
    CHECK(covered > 50);
    CHECK(darker > 50);
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("a surface follows the device buffer that it names")
{
    TAUT_DRAWING(device);
    Renderer renderer(device);
    Surface surface = square(0, kRed, kRed);
    const Surface from_host[] = {surface};
    const Image host = renderer.draw(small_shot(), from_host);
    surface.buffer = device->make_buffer(surface.positions.size() * sizeof(glm::vec4), "square");
    device->write<glm::vec4>(surface.buffer, surface.positions);
    surface.positions.clear();
    const Surface in_place[] = {surface};
    CHECK(differing(host, renderer.draw(small_shot(), in_place)) == 0);
    device->write<glm::vec4>(surface.buffer, std::vector<glm::vec4>(4, glm::vec4(100)));
    CHECK(differing(renderer.draw(small_shot(), {}), renderer.draw(small_shot(), in_place)) == 0);
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("a renderer refuses what it cannot draw, by name")
{
    TAUT_DRAWING(device);
    check_refusal(ErrorCode::unsupported, [] { Renderer(test_device("cpu")); });
    CHECK_FALSE(can_draw(*test_device("cpu")));
    Renderer renderer(device);
    Surface surface = square(0, kRed, kRed);
    const auto draw = [&](const Shot& shot) { renderer.draw(shot, std::span<const Surface>(&surface, 1)); };
    surface.triangles[4] = 4;
    check_refusal(ErrorCode::bad_input, [&] { draw(small_shot()); });
    surface.triangles = {0, 1};
    check_refusal(ErrorCode::bad_input, [&] { draw(small_shot()); });
    surface.triangles.clear();
    Shot shot = small_shot();
    shot.width = 0;
    check_refusal(ErrorCode::bad_input, [&] { draw(shot); });
    shot.width = 1u << 30;
    check_refusal(ErrorCode::limit, [&] { draw(shot); });
    surface.buffer = test_device("cpu")->make_buffer(64, "elsewhere");
    check_refusal(ErrorCode::unsupported, [&] { draw(small_shot()); });
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("one state gives the same picture from every executor, bit for bit")
{
    TAUT_DRAWING(device);
    Scene scene = test::everything();
    Mesh& mesh = scene.bodies[0].mesh;
    mesh.grid_columns = mesh.grid_rows = 0; // any mesh, not a grid: the plan orders its vertices anew
    scene.bodies.push_back(scene.bodies[0]);
    for (glm::dvec3& p : scene.bodies[1].mesh.positions)
        p += glm::dvec3(0.6, 0.3, 0);
    WorldOptions options;
    options.plan.small_bodies = PlanOptions::SmallBodies::never;
    World first(scene, test_device("cpu:serial"), options);
    REQUIRE_FALSE(std::is_sorted(first.plan().original.begin(), first.plan().original.end()));
    for (int i = 0; i < 12; ++i)
        first.step();
    const WorldState state = first.state();
    const PictureMoment moment = {first.time(), first.positions()};
    const Shot shot = frame_shot(first.scene(), std::span(&moment, 1), 320, 240);
    Pictures pictures(first.scene(), device);
    const Image image = pictures.draw(moment, shot);
    CHECK(differing(image, Renderer(device).draw(shot, {})) > 1000);
    for (const std::string& selector : test_devices())
    {
        INFO(selector);
        World world(scene, test_device(selector), options);
        world.restore(state);
        CHECK(differing(image, pictures.draw(world, shot)) == 0);
    }
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("capsules and boxes are drawn where they lie, turned as they are")
{
    TAUT_DRAWING(device);
    Scene scene = test::hanging(2);
    const PictureMoment moment = {0, scene.bodies[0].mesh.positions};
    const Shot shot = frame_shot(scene, std::span(&moment, 1), 320, 240);
    const auto draw = [&](const Collider& collider) {
        scene.colliders = {collider};
        return Pictures(scene, device).draw(moment, shot);
    };
    Collider ball, capsule, box;
    ball.radius = 0.3;
    ball.point = {0, 0, 0.5};
    const Image round = draw(ball);
    capsule = ball;
    capsule.kind = ColliderKind::capsule;
    capsule.end = capsule.point; // without length it is a ball
    CHECK(differing(draw(capsule), round) == 0);
    capsule.end.y += 0.3;
    CHECK(differing(draw(capsule), round) > 500);
    box = ball;
    box.kind = ColliderKind::cuboid;
    box.half_size = {0.3, 0.2, 0.1};
    const Image square = draw(box);
    CHECK(differing(square, round) > 500);
    box.rotate_degrees = 90;
    const Image turned = draw(box);
    CHECK(differing(turned, square) > 500);
    box.rotate_degrees = 0;
    box.motion = {{0, {0, 0, 0}, {0, 1, 0}, 90, box.point}};
    CHECK(differing(draw(box), turned) < 100); // but for rounding at its edges
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("a solid is drawn by the surface that it carries")
{
    TAUT_DRAWING(device);
    Scene scene;
    scene.bodies.resize(1);
    scene.bodies[0].shape.kind = ShapeKind::box;
    scene.bodies[0].shape.box_cells = {2, 2, 2};
    scene.bodies[0].material = solid_material();
    scene = resolve(scene);
    const Scene plain = scene;
    scene.bodies[0].embedding = embed(test::sphere_mesh(6, 0.4), scene.bodies[0].mesh);
    Scene ball = plain; // cloth of the same shape
    ball.bodies[0].mesh = test::sphere_mesh(6, 0.4);
    World world(scene, test_device("cpu:serial"));
    const PictureMoment moment = {0, world.positions()}, of_ball = {0, ball.bodies[0].mesh.positions};
    const Shot shot = frame_shot(scene, std::span(&moment, 1), 320, 240);
    const Image seen = Pictures(scene, device).draw(moment, shot);
    CHECK(differing(seen, Pictures(ball, device).draw(of_ball, shot)) == 0);
    CHECK(differing(seen, Pictures(plain, device).draw(moment, shot)) > 500);
    World in_place(scene, device); // which would be drawn from its own buffer
    CHECK(differing(seen, Pictures(scene, device).draw(in_place, shot)) == 0);
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("worlds in double precision and chains are drawn")
{
    TAUT_DRAWING(device);
    Scene scene = test::chain(5, 1000, 0.01);
    scene.method.precision = Precision::float64;
    World world(scene, device);
    world.step();
    const PictureMoment moment = {world.time(), world.positions()};
    const Shot shot = frame_shot(world.scene(), std::span(&moment, 1), 160, 120);
    Pictures pictures(world.scene(), device);
    const Image image = pictures.draw(world, shot);
    CHECK(differing(image, Renderer(device).draw(shot, {})) > 100);
    CHECK(differing(image, pictures.draw(moment, shot)) == 0);
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("a run leaves a picture and a contact sheet with a cell for each moment")
{
    TAUT_DRAWING(device);
    Folder folder;
    World world(test::hanging(), device);
    PictureOptions options;
    options.width = 200;
    options.height = 150;
    options.cell_width = 120;
    options.cell_height = 90;
    options.columns = 3;
    Pictures pictures(world.scene(), device, options);
    check_refusal(ErrorCode::bad_input, [&] { pictures.write(folder.path); });
    for (int frame = 0; frame < 4; ++frame)
    {
        pictures.capture(world);
        world.step();
    }
    CHECK(pictures.write(folder.path) == std::vector<std::string>{"picture.png", "contact_sheet.png"});
    const Image picture = read_png(folder.path / "picture.png");
    CHECK(picture.width == 200);
    CHECK(picture.height == 150);
    const Image sheet = read_png(folder.path / "contact_sheet.png");
    CHECK(sheet.width == 3 * 120 + 2 * 4);
    CHECK(sheet.height == 2 * 90 + 4);
    CHECK(pixel(sheet, sheet.width - 1, sheet.height - 1) == glm::ivec3(255)); // no fifth moment
    pictures.add({1.0, {glm::dvec3(0)}});
    check_refusal(ErrorCode::bad_input, [&] { pictures.write(folder.path); });
    CHECK_NOTHING_SAID(device);
}

// Run by the test below in a process of its own, where the Vulkan loader finds no driver.
TEST_CASE("without Vulkan, pictures say that there is no device", "[.][without_vulkan]")
{
    check_refusal(ErrorCode::no_device, [] { open_drawing_device(); });
    check_refusal(ErrorCode::no_device, [] { Pictures pictures(test::hanging(2), test_device("cpu")); });
}

TEST_CASE("a machine without a Vulkan driver refuses pictures and nothing else")
{
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::string command =
        "VK_DRIVER_FILES=/none VK_ICD_FILENAMES=/none '" + self + "' '[without_vulkan]' > /dev/null";
    CHECK(std::system(command.c_str()) == 0);
}
