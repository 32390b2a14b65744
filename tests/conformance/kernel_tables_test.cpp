// The generated tables and the compiler that makes them.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/kernel_text.hpp"
#include "taut/runtime/base/registry.hpp"
#include "taut/runtime/base/spirv.hpp"
#include "taut/runtime/compiler/variants.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

using namespace taut;

namespace {

/// Capabilities that a module asks for, by their number in the SPIR-V specification.
std::set<std::uint32_t> capabilities(std::span<const std::uint32_t> spirv)
{
    std::set<std::uint32_t> found;
    each_instruction(spirv, [&](spv::Op op, std::size_t, std::span<const std::uint32_t> operands) {
        if (op == spv::OpCapability)
            found.insert(operands[0]);
    });
    return found;
}

const std::filesystem::path kKernels = TAUT_SOURCE_DIR "/kernels";

std::string text_of(const std::filesystem::path& path)
{
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The names of the kernels of one text: of one that is compiled for elements, each with its own.
std::vector<std::string> names_of(const std::filesystem::path& path)
{
    const std::string stem = path.stem().string(), each = each_of(text_of(path));
    if (each.empty())
        return {stem};
    std::vector<std::string> names;
    for (const std::string folder : {"elements", "colliders"})
        for (const auto& entry : std::filesystem::directory_iterator(kKernels / folder))
        {
            const ElementFile element =
                element_file(folder + "/" + entry.path().filename().string(), text_of(entry.path()));
            if (is_for(each, element))
                names.push_back(stem + "_" + element.stem);
        }
    return names;
}

std::set<std::string> kernel_stems()
{
    std::set<std::string> stems;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kKernels))
        if (entry.path().extension() == ".comp")
            for (const std::string& name : names_of(entry.path()))
                stems.insert(name);
    return stems;
}

/// A kernel of the build as its file says, to be compiled in one of its variants.
KernelSource source_of(const std::string& stem)
{
    const KernelFile file = find_kernel_file(kKernels, stem);
    INFO("kernel " << stem);
    REQUIRE(!file.path.empty());
    return {stem, text_of(file.path), {}, {}, Precision::float32, file.element};
}

std::vector<KernelVariant> variants_of(const KernelSource& source)
{
    return kernel_variants(source.name, source.text, source.element);
}

bool contains(const std::string& text, const std::string& part)
{
    INFO(text);
    return text.find(part) != std::string::npos;
}

const std::string kHead = "#include \"shared/portable.glsl\"\nPARAMS { uint count; };\n";

} // namespace

TEST_CASE("every kernel file is in the tables in both precisions with all of its variants")
{
    for (const std::string& stem : kernel_stems())
        for (const KernelVariant& variant : variants_of(source_of(stem)))
            for (const Precision precision : {Precision::float32, Precision::float64})
            {
                CAPTURE(stem, variant.name, to_string(precision));
                CHECK_NOTHROW(find_kernel(stem, variant.name, precision));
            }
    std::set<std::string> known;
    for (const KernelInfo* kernel : all_kernels())
        known.insert(std::string(kernel->name));
    CHECK(known == kernel_stems());
}

TEST_CASE("every kernel keeps to the rules of a base kernel")
{
    for (const KernelInfo* kernel : all_kernels())
    {
        CAPTURE(kernel->name, kernel->variant, to_string(kernel->precision));
        CHECK(kernel->bindings.size() <= 8);
        for (std::size_t i = 0; i < kernel->bindings.size(); ++i)
        {
            CHECK(kernel->bindings[i].slot == i);
            CHECK(kernel->bindings[i].stride > 0);
            CHECK(kernel->bindings[i].stride % 4 == 0);
        }
        CHECK(kernel->param_bytes <= 64);
        CHECK(kernel->param_bytes == 4 * kernel->params.size()); // 32-bit scalars, packed
        CHECK(kernel->group_size <= 128);                        // what every device offers
        CHECK((kernel->group_kernel || kernel->group_size == kGroupSize));
        CHECK(kernel->shared_bytes <= 32 * 1024);
        CHECK(kernel->native != nullptr);
        CHECK_FALSE(kernel->spirv_vulkan.empty());
        CHECK_FALSE(kernel->spirv_opengl.empty());
        CHECK(kernel->glsl.starts_with("#version 450"));
    }
}

TEST_CASE("no kernel asks for more than it may: 64-bit floats in double only, no other capability")
{
    constexpr std::uint32_t kShader = 1;
    for (const KernelInfo* kernel : all_kernels())
        for (const auto spirv : {kernel->spirv_vulkan, kernel->spirv_opengl})
        {
            CAPTURE(kernel->name, kernel->variant, to_string(kernel->precision));
            std::set<std::uint32_t> found = capabilities(spirv);
            if (kernel->precision == Precision::float64)
                found.erase(spv::CapabilityFloat64); // a kernel of whole numbers alone does without
            CHECK(found == std::set<std::uint32_t>{kShader});
            CHECK(capabilities(spirv).count(spv::CapabilityInt64) == 0);
        }
}

TEST_CASE("variants differ from the base kernel in their own bindings, and parameters are the same in all")
{
    for (const KernelInfo* kernel : all_kernels())
    {
        // Their passes share a way through the data, not what they read and write.
        if (kernel->name == "stencil7" || kernel->name == "spmv_coo" || kernel->name == "chebyshev" ||
            kernel->name == "constraint_spread" || kernel->name == "corner_spread" ||
            kernel->name == "implicit_trial" || kernel->name == "contact_search" ||
            kernel->name == "contact_stray")
            continue;
        if (kernel->name == "vbd_solve" && kernel->variant == "added")
            continue; // the inertia comes with the block, which takes the place of the guess
        CAPTURE(kernel->name, kernel->variant);
        const KernelInfo& base = find_kernel(kernel->name, "", kernel->precision);
        REQUIRE(kernel->params.size() == base.params.size());
        for (std::size_t i = 0; i < base.params.size(); ++i)
            CHECK((kernel->params[i].name == base.params[i].name &&
                   kernel->params[i].offset == base.params[i].offset));
        std::set<std::string_view> names;
        for (const BindingInfo& binding : kernel->bindings)
            names.insert(binding.name);
        for (const BindingInfo& binding : base.bindings)
            CHECK(names.count(binding.name) == 1);
    }
}

TEST_CASE("flattened text has no include and no REAL left")
{
    for (const KernelInfo* kernel : all_kernels())
    {
        CAPTURE(kernel->name, kernel->variant, to_string(kernel->precision));
        std::istringstream lines{std::string(kernel->glsl)};
        for (std::string line; std::getline(lines, line);)
        {
            line = line.substr(0, line.find("//")); // comments may speak of them
            CHECK(line.find("REAL(") == std::string::npos);
            CHECK_FALSE(line.starts_with("#include \"")); // <cstdint> is for the host, behind its macro
        }
    }
}

TEST_CASE("REAL becomes a literal with all its digits in the precision of the kernel")
{
    const std::string text =
        kHead + "WRITE(0, real, result);\nKERNEL(count) { result[i] = REAL(0.1) * REAL(1e-3); }\n";
    CHECK(contains(std::string(compile_sample(text)->info.glsl), "result[i] = (0.1f) * (1e-3f);"));
    CHECK(contains(std::string(compile_sample(text, Precision::float64)->info.glsl),
                   "result[i] = (0.1lf) * (1e-3lf);"));
}

TEST_CASE("a variant line gives its macros to the variant and 0 to every other one")
{
    const auto variants =
        kernel_variants("sample", "//! variant fast FAST=1 WIDTH=4\n//! variant safe SAFE=1\n");
    REQUIRE(variants.size() == 3);
    const auto value = [](const KernelVariant& variant, const std::string& macro) {
        for (const auto& [name, text] : variant.defines)
            if (name == macro)
                return text;
        return std::string("none");
    };
    CHECK(variants[0].name == "");
    CHECK(value(variants[0], "FAST") == "0");
    CHECK(value(variants[0], "SAFE") == "0");
    CHECK(variants[1].name == "fast");
    CHECK(value(variants[1], "FAST") == "1");
    CHECK(value(variants[1], "WIDTH") == "4");
    CHECK(value(variants[1], "SAFE") == "0");
    CHECK(variants[2].name == "safe");
    CHECK(value(variants[2], "WIDTH") == "0");
}

TEST_CASE("what an element has is a macro of the kernels that are compiled for it")
{
    const ElementFile element =
        element_file("elements/rod.glsl", "//! corners 3\n//! methods pbd\n//! with bounds\n");
    using Defines = std::vector<std::pair<std::string, std::string>>;
    CHECK(element_defines(element) ==
          Defines{{"ELEMENT_STEM", "rod"}, {"ELEMENT_CORNERS", "3"}, {"ELEMENT_WITH_BOUNDS", "1"}});
}

TEST_CASE("a variant line without a value is refused with its text")
{
    try
    {
        kernel_variants("sample", "//! variant fast FAST\n");
        FAIL("it was taken");
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::kernel_compilation);
        CHECK(contains(error.what(), "sample"));
        CHECK(contains(error.what(), "variant fast FAST"));
    }
}

TEST_CASE("a text that does not compile is refused with file and line")
{
    const std::string text =
        kHead + "WRITE(0, real, result);\nKERNEL(count)\n{\n    result[i] = no_such_name;\n}\n";
    const std::string what = sample_refusal(text);
    CHECK(contains(what, "sample.comp:6"));
    CHECK(contains(what, "no_such_name"));
}

TEST_CASE("a mistake in an include is reported at the include's own line")
{
    const auto folder = std::filesystem::temp_directory_path() / "taut_kernel_tables_test";
    std::filesystem::create_directories(folder / "shared");
    std::ofstream(folder / "shared" / "part.glsl")
        << "// a comment\n\nreal half_of(real x) { return x / two; }\n";
    std::ofstream(folder / "shared" / "portable.glsl") << builtin_include("shared/portable.glsl");
    const std::string text =
        "#include \"shared/portable.glsl\"\n#include \"shared/part.glsl\"\nPARAMS { uint count; };\n"
        "WRITE(0, real, result);\nKERNEL(count) { result[i] = half_of(real(1)); }\n";
    std::string what;
    try
    {
        compile_kernel({"sample", text, folder, {}, Precision::float32});
    }
    catch (const Error& error)
    {
        what = error.what();
    }
    std::filesystem::remove_all(folder);
    CHECK(contains(what, "shared/part.glsl:3"));
}

TEST_CASE("an unknown include is refused by name and place")
{
    const std::string what =
        sample_refusal("#include \"shared/portable.glsl\"\n#include \"shared/nowhere.glsl\"\n");
    CHECK(contains(what, "shared/nowhere.glsl"));
    CHECK(contains(what, "sample.comp:2"));
}

TEST_CASE("slots with a gap, too many buffers and vector parameters are refused by name")
{
    const std::string body = "KERNEL(count) { result[i] = first[i]; }\n";
    const std::string gap = sample_refusal(kHead + "READ(0, real, first);\nWRITE(2, real, result);\n" + body);
    CHECK(contains(gap, "slot 1"));
    CHECK(contains(gap, "sample"));

    std::string many = kHead + "READ(0, real, first);\nWRITE(1, real, result);\n",
                sum = "KERNEL(count) { result[i] = first[i]";
    for (int slot = 2; slot < 9; ++slot)
    {
        const std::string name = "more" + std::to_string(slot);
        many += "READ(" + std::to_string(slot) + ", real, " + name + ");\n";
        sum += " + " + name + "[i]";
    }
    const std::string nine = sample_refusal(many + sum + "; }\n");
    CHECK(contains(nine, "9"));
    CHECK(contains(nine, "limit is 8"));

    const std::string vector =
        sample_refusal("#include \"shared/portable.glsl\"\nPARAMS { uint count; vec4 wind; };\n"
                       "READ(0, real, first);\nWRITE(1, real, result);\n"
                       "KERNEL(count) { result[i] = first[i] * wind.x; }\n");
    CHECK(contains(vector, "wind"));
    CHECK(contains(vector, "32-bit"));
}

TEST_CASE("a kernel compiled at run time has the tables of the same kernel compiled by the build")
{
    for (const KernelInfo* built : all_kernels())
    {
        CAPTURE(built->name, built->variant, to_string(built->precision));
        KernelSource source = source_of(std::string(built->name));
        source.precision = built->precision;
        for (const KernelVariant& variant : variants_of(source))
        {
            if (variant.name != built->variant)
                continue;
            source.variant = variant;
            const auto now = compile_kernel(source);
            CHECK(now->info.glsl == built->glsl);
            CHECK(std::equal(now->spirv_vulkan.begin(), now->spirv_vulkan.end(), built->spirv_vulkan.begin(),
                             built->spirv_vulkan.end()));
            CHECK(now->info.bindings.size() == built->bindings.size());
            CHECK(now->info.param_bytes == built->param_bytes);
            CHECK(now->info.group_kernel == built->group_kernel);
        }
    }
}

TEST_CASE("a kernel compiled at run time runs on every device that takes texts, and is refused on the others")
{
    const std::string text = kHead + "READ(0, real, first);\nWRITE(1, real, result);\nKERNEL(count) { "
                                     "result[i] = first[i] * REAL(0.5); }\n";
    const auto kernel = compile_sample(text);
    struct Params
    {
        std::uint32_t count;
    };
    for (const std::string& selector : test_devices())
    {
        CAPTURE(selector);
        const auto device = test_device(selector);
        const BufferPtr first = device->make_buffer(65 * 4, "first"),
                        result = device->make_buffer(65 * 4, "result");
        device->write<float>(first, std::vector<float>(65, 3));
        Recorder recorder(device);
        recorder.dispatch(kernel->info, {first, result}, Params{65}, 65);
        if (selector.starts_with("cpu"))
        {
            CHECK_THROWS_AS(recorder.finish(), Error);
            continue;
        }
        recorder.finish()->replay();
        CHECK(device->read<float>(result, 65) == std::vector<float>(65, 1.5f));
    }
}
