#include "taut/cli/contact_watch.hpp"

#include "taut/judge/crossings.hpp"
#include "taut/judge/scene_triangles.hpp"
#include "taut/plan/contact_scene.hpp"
#include "taut/report/look_due.hpp"
#include "taut/report/soundness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace taut::cli {
namespace {

constexpr std::uint64_t kLooks = 16; // behind the start, the last one at the end

/// Triangles of which every frame is looked at.
constexpr std::size_t kSmall = 2'500;

std::string name_of(const Scene& scene, std::uint32_t body)
{
    const std::string& name = scene.bodies[body].name;
    return "bodies[" + std::to_string(body) + "]" + (name.empty() ? "" : " (\"" + name + "\")");
}

/// Of each vertex of a scene the first one of its body that rests in the same place, where the body can tear:
/// what has come apart begins in one place. Of others itself.
std::vector<std::uint32_t> untorn_vertices(const Scene& scene)
{
    std::vector<std::uint32_t> out;
    for (const Body& body : scene.bodies)
    {
        std::map<std::array<double, 3>, std::uint32_t> at;
        for (const glm::dvec3& x : body.mesh.positions)
        {
            const auto v = static_cast<std::uint32_t>(out.size());
            const bool tears = body.material.tear_strain > 0;
            out.push_back(tears ? at.emplace(std::array{x.x, x.y, x.z}, v).first->second : v);
        }
    }
    return out;
}

/// The guarantee is lost only where something is pinched.
std::string advice(bool guarded, const std::string& without)
{
    return guarded ? "; raise method.substeps, move what is led more slowly, or leave more place between "
                     "what is led"
                   : without + ", or let contact.guarantee be \"no_crossing\"";
}

} // namespace

ContactWatch::ContactWatch(const Simulation& simulation, std::uint64_t frames)
    : simulation_(simulation),
      frames_(frames),
      wanted_(wants_contact(simulation.scene())),
      guarded_(simulation.scene().contact.guarantee == Guarantee::no_crossing)
{
    if (!wanted_)
        return;
    before_ = simulation_.positions();
    look(0, before_);
    at_start_ = most_;
}

void ContactWatch::after(std::uint64_t frame)
{
    if (!wanted_)
        return;
    std::vector<glm::dvec3> positions = simulation_.positions();
    for (const glm::dvec3& x : positions)
        if (!(glm::length(x) < 1e30)) // the run ends as non_finite or diverged
            return;
    if (surface_.parts > 1 && before_.size() == positions.size()) // not where cloth has just torn
        look_between(frame, positions);
    const std::uint64_t pinched = guarded_ ? simulation_.pinched() : 0;
    if (look_due(frame, frames_, kLooks) || surface_.triangles.size() <= kSmall || pinched > pinched_)
        look(frame, positions);
    pinched_ = pinched;
    before_ = std::move(positions);
}

/// Cloth that tears has other triangles than before.
void ContactWatch::learn_surfaces()
{
    judging::SceneTriangles all = judging::scene_triangles(simulation_.scene());
    body_ = std::move(all.body);
    surface_ = judging::make_surface(body_.size(), std::move(all.triangles), std::move(all.led));
    untorn_ = untorn_vertices(simulation_.scene());
}

/// Two features that had a common vertex, which has come apart: they touch there until they move.
bool ContactWatch::torn_apart(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) const
{
    for (const std::uint32_t v : a)
        for (const std::uint32_t w : b)
            if (v != w && untorn_[v] == untorn_[w])
                return true;
    return false;
}

bool ContactWatch::meets(std::uint32_t a, std::uint32_t b) const
{
    return surfaces_meet(simulation_.scene(), a, b);
}

bool ContactWatch::meets_passing(const judging::Passing& p) const
{
    using Feature = std::span<const std::uint32_t>;
    const Feature a = p.edges ? Feature(surface_.edges[p.a]) : Feature(&p.a, 1);
    const Feature b = p.edges ? Feature(surface_.edges[p.b]) : Feature(surface_.triangles[p.b]);
    return surface_.part[a[0]] != surface_.part[b[0]] && meets(body_[a[0]], body_[b[0]]) && !torn_apart(a, b);
}

/// A sheet that falls flat and fast through another one crosses it in no frame.
void ContactWatch::look_between(std::uint64_t frame, const std::vector<glm::dvec3>& positions)
{
    for (const judging::Passing& p : judging::passing_pairs(surface_, before_, positions))
        if (meets_passing(p) && passed_++ == 0)
            passed_frame_ = frame;
}

void ContactWatch::look(std::uint64_t frame, const std::vector<glm::dvec3>& positions)
{
    if (positions.size() != body_.size())
        learn_surfaces();
    std::size_t count = 0;
    std::string bodies;
    for (const auto& [s, t] : judging::intersecting_triangles(surface_, positions))
    {
        const std::uint32_t a = body_[surface_.triangles[s][0]], b = body_[surface_.triangles[t][0]];
        if (!meets(a, b) || torn_apart(surface_.triangles[s], surface_.triangles[t]))
            continue;
        ++count;
        if (bodies.empty())
            bodies = a == b ? name_of(simulation_.scene(), a) + " and itself"
                            : name_of(simulation_.scene(), a) + " and " + name_of(simulation_.scene(), b);
    }
    if (count > most_)
    {
        most_ = count;
        most_frame_ = frame;
        most_bodies_ = bodies;
    }
}

void ContactWatch::describe(StepReport& report, std::vector<std::string>& messages) const
{
    if (!wanted_)
        return;
    if (most_ > 0)
    {
        Soundness crossed;
        crossed.status = Status::unconverged;
        crossed.reason =
            "surfaces that are to meet go through each other: " + std::to_string(most_) +
            " pairs of triangles after frame " + std::to_string(most_frame_) + ", the first of " +
            most_bodies_ +
            (at_start_ > 0 ? "; they do so at the start, and contact does not part what has crossed"
                           : advice(report.contacts.guarded, "; raise method.substeps or contact.sweeps"));
        set_status(crossed, report);
    }
    // Ways are not straight between two frames. Under the guarantee they are known to be clear.
    const bool known = report.contacts.guarded && report.contacts.pinched == 0;
    if (most_ == 0 && passed_ > 0 && !known)
    {
        Soundness passed;
        passed.status = Status::unconverged;
        passed.reason =
            "surfaces that are to meet have passed through each other: vertices and triangles, or edges, "
            "in " +
            std::to_string(passed_) + " places, first before frame " + std::to_string(passed_frame_) +
            advice(report.contacts.guarded, "; raise method.substeps or contact.sweeps, shorten timestep");
        set_status(passed, report);
    }
    if (at_start_ > 0)
        messages.push_back(
            "contact: at the start " + std::to_string(at_start_) +
            " pairs of triangles that are to meet go through each other; move the bodies apart");
    const ContactCounts& c = report.contacts;
    const auto say = [&](std::uint64_t times, const char* what) {
        if (times > 0)
            messages.push_back("contact: " + std::to_string(times) + what);
    };
    say(c.pinched, " times held vertices that move left others no place, or ran them over: the guarantee "
                   "does not hold there");
    say(c.missing, " pairs found no place in their list, which has grown since");
    say(c.cut, " searches met more triangles than they may take; a thickness below the edges of the mesh "
               "avoids that");
    say(c.crowded, " times a vertex was in more pairs than may push it, so none did, and its partners were "
                   "pushed alone; a smaller thickness, or meshes that are about as fine as each other, "
                   "avoid that");
}

} // namespace taut::cli
