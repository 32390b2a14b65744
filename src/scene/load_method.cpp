#include "taut/scene/load_method.hpp"

namespace taut::scene_file {
namespace {

void read_substeps(const Field& method, std::uint32_t& out)
{
    constexpr std::string_view right = "it must be a whole number from 1 to 1000, or \"automatic\"";
    const auto substeps = method.find("substeps");
    if (!substeps)
        return;
    if (!substeps->is_text())
        out = substeps->count(right);
    if (substeps->is_text() ? substeps->text() != "automatic" : out == 0)
        substeps->refuse(std::string(right));
}

/// Of a member whose range is smaller than that of whole numbers. check() says the same of whole ones beyond
/// it.
void read_count(const Field& method, std::string_view key, std::string_view right, std::uint32_t& out)
{
    Field::attempt([&] {
        if (const auto count = method.find(key))
            out = count->count(right);
    });
}

} // namespace

void read_method(Field field, MethodSettings& method)
{
    field.object("method");
    field.read("type", method.type);
    Field::attempt([&] { read_substeps(field, method.substeps); });
    read_count(field, "iterations", "it must be a whole number from 1 to 1000", method.iterations);
    field.read("precision", method.precision);
    field.read("integrator", method.integrator);
    field.read("stability", method.stability);
    field.read("scheme", method.scheme);
    field.read("stretch", method.stretch);
    field.read("bend", method.bend);
    field.read("volume", method.volume);
    field.read("relaxation", method.relaxation);
    read_count(field, "linear_iterations", "it must be a whole number from 1 to 100000",
               method.linear_iterations);
    field.read("linear_tolerance", method.linear_tolerance);
    field.read("linear_operator", method.linear_operator);
    field.read("line_search", method.line_search);
    field.read("constrained", method.constrained);
    if (const auto compliance = field.find("constraint_compliance"))
    {
        if (!compliance->is_text())
            method.constraint_compliance = compliance->number();
        else if (compliance->text() != "material")
            compliance->refuse("it must be a number in m/N or \"material\"");
        if (method.constraint_compliance < 0 && !compliance->is_text())
            compliance->refuse("it must be 0 or more, or \"material\"");
    }
    field.read("activate_strain", method.activate_strain);
    method.release_strain = method.activate_strain;
    field.read("release_strain", method.release_strain);
    field.read("release", method.release);
    field.read("target", method.target);
    field.read("compress", method.compress);
    field.read("start", method.start);
    field.read("spectral_radius", method.spectral_radius);
}

Accept read_accept(Field field)
{
    field.object("accept");
    Accept accept;
    field.read("stretch", accept.stretch);
    field.read("residual", accept.residual);
    field.read("inverted", accept.inverted);
    return accept;
}

} // namespace taut::scene_file
