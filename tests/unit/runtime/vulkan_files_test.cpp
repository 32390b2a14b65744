// What the Vulkan executor reads and writes on disk, and what the validation layers say of wrong use.

#include "vulkan_support.hpp"

#include "taut/runtime/compiler/override.hpp"
#include "taut/runtime/vulkan/context.hpp"
#include "taut/runtime/vulkan/pipeline_cache.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <sys/stat.h>
#include <unistd.h>

using namespace taut;
using namespace taut::vulkan_test;
namespace fs = std::filesystem;

namespace {

/// An empty folder that goes away with the test.
class Folder
{
public:
    Folder()
    {
        static int number = 0;
        path = fs::temp_directory_path() /
               ("taut-vulkan-" + std::to_string(getpid()) + "-" + std::to_string(number++));
        fs::create_directories(path);
    }
    ~Folder() { fs::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::size_t file_count() const
    {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(path), fs::directory_iterator()));
    }

    fs::path path;
};

std::string read_text(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void write_text(const fs::path& path, const std::string& text)
{
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
}

/// Opens with a cache, compiles one kernel, computes, closes.
bool use_cache(const std::string& path)
{
    const std::shared_ptr<Device> device = open_here(true, path);
    if (!device)
        return false;
    const BufferPtr x = device->make_buffer(64, "x");
    Recorder recorder(device);
    recorder.dispatch(affine(), {x}, AffineParams{16, 1, 3}, 16);
    recorder.finish()->replay();
    CHECK(device->read<float>(x, 16) == std::vector<float>(16, 3.0f));
    CHECK_NOTHING_SAID(device);
    return true;
}

VkPhysicalDeviceProperties properties_here()
{
    return vulkan::context_of(*open_vulkan(0, {}))->physical.properties;
}

/// An environment variable for the length of a test.
class Variable
{
public:
    Variable(const char* name, const std::string& value) : name_(name)
    {
        if (const char* old = std::getenv(name))
            old_ = old;
        setenv(name, value.c_str(), 1);
    }
    ~Variable() { old_ ? setenv(name_, old_->c_str(), 1) : unsetenv(name_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

private:
    const char* name_;
    std::optional<std::string> old_;
};

class KernelDir : Variable
{
public:
    explicit KernelDir(const fs::path& path) : Variable("TAUT_KERNEL_DIR", path.string()) {}
};

/// A folder as a person would have it: shared/ and one kernel.
void make_kernel_folder(const fs::path& path, const std::string& body)
{
    fs::copy(fs::path(TAUT_SOURCE_DIR) / "kernels" / "shared", path / "shared", fs::copy_options::recursive);
    write_text(path / "step" / "affine.comp", "#include \"shared/portable.glsl\"\n" + body);
}

} // namespace

TEST_CASE("a pipeline cache is written when the device closes, and not before")
{
    const Folder folder;
    const std::string path = (folder.path / "pipelines.bin").string();
    {
        const std::shared_ptr<Device> device = open_here(false, path);
        if (!device)
            return;
        CHECK(folder.file_count() == 0);
    }
    CHECK(folder.file_count() == 1);
    CHECK(!vulkan::load_pipeline_cache(path, properties_here()).empty());
    CHECK(use_cache(path)); // and is read again
    CHECK(folder.file_count() == 1);
}

TEST_CASE("without a path no pipeline cache is written")
{
    const Folder folder;
    const fs::path before = fs::current_path();
    fs::current_path(folder.path);
    const bool used = use_cache("");
    fs::current_path(before);
    if (used)
        CHECK(folder.file_count() == 0);
}

TEST_CASE("a damaged or truncated pipeline cache, or that of another driver, is ignored and rewritten")
{
    const Folder folder;
    const std::string path = (folder.path / "pipelines.bin").string();
    if (!use_cache(path))
        return;
    const VkPhysicalDeviceProperties here = properties_here();
    const std::string good = read_text(path);
    REQUIRE(good.size() > 60);
    std::vector<std::string> bad = {
        "", "x", good.substr(0, 20), good.substr(0, 56), good.substr(0, good.size() - 1), good + "x"};
    // Every field of the header: magic, version, vendor, device, driver, UUID, size, hash; then the contents.
    const std::size_t fields[] = {0, 8, 12, 16, 20, 24, 40, 48, 56};
    for (const std::size_t at : fields)
    {
        bad.push_back(good);
        bad.back()[at] = static_cast<char>(bad.back()[at] ^ 1);
    }
    bad.push_back(good);
    bad.back().back() = static_cast<char>(bad.back().back() ^ 0x40);
    for (const std::string& text : bad)
    {
        write_text(path, text);
        CHECK(vulkan::load_pipeline_cache(path, here).empty());
    }
    for (const std::string& text : {bad[2], bad[7], bad.back()})
    {
        write_text(path, text);
        CHECK(use_cache(path));
        CHECK(!vulkan::load_pipeline_cache(path, here).empty());
    }
    VkPhysicalDeviceProperties other = here;
    other.driverVersion += 1;
    CHECK(vulkan::load_pipeline_cache(path, other).empty());
    CHECK(folder.file_count() == 1);
}

TEST_CASE("a pipeline cache in a folder that does not exist is refused when the device opens")
{
    if (list_vulkan().empty())
        return;
    const Folder folder;
    const std::string path = (folder.path / "no" / "pipelines.bin").string();
    const Refusal refused = refusal([&] { open_here(false, path); });
    CHECK(refused.code == ErrorCode::io);
    CHECK(contains(refused.text, path));
}

TEST_CASE("what is no pipeline cache is refused in the place of one, and left alone")
{
    const Folder folder;
    const fs::path there = folder.path / "pipelines.bin";
    const std::string kind = GENERATE("a pipe", "a folder", "a letter", "TAUTPIP.");
    if (kind == "a pipe")
        REQUIRE(mkfifo(there.c_str(), 0600) == 0);
    else if (kind == "a folder")
        fs::create_directory(there);
    else
        write_text(there, kind);
    const bool file = fs::is_regular_file(there);
    VkPhysicalDeviceProperties here{};
    CHECK(vulkan::load_pipeline_cache(there.string(), here).empty()); // and does not wait for a writer
    CHECK_FALSE(vulkan::save_pipeline_cache(there.string(), here, {}));
    CHECK(fs::is_regular_file(there) == file);
    if (!list_vulkan().empty())
    {
        const Refusal refused = refusal([&] { open_here(false, there.string()); });
        CHECK(refused.code == ErrorCode::io);
        CHECK(contains(refused.text, file ? "is no pipeline cache of Taut" : kind + "; name a file"));
    }
    if (file)
        CHECK(read_text(there) == kind);
}

TEST_CASE("an edited kernel text in TAUT_KERNEL_DIR takes the place of the built-in one")
{
    TAUT_VULKAN_DEVICE(device);
    const auto run = [&] {
        const BufferPtr x = device->make_buffer(64, "x");
        Recorder recorder(device);
        recorder.dispatch(affine(), {x}, AffineParams{16, 1, 3}, 16);
        recorder.finish()->replay();
        return device->read<float>(x, 1)[0];
    };
    CHECK(run() == 3.0f);
    {
        const Folder folder;
        std::string text = kAffineText;
        text.replace(text.find("+ add"), 5, "+ 10.0f * add");
        make_kernel_folder(folder.path, text);
        const KernelDir variable(folder.path);
        CHECK(run() == 30.0f);
        write_text(folder.path / "step" / "affine.comp",
                   "#include \"shared/portable.glsl\"\n" + std::string(kAffineText)); // edited while it runs
        CHECK(run() == 3.0f);
        fs::remove(folder.path / "step" / "affine.comp");
        CHECK(kernel_override(affine()) == nullptr);
        CHECK(run() == 3.0f);
    }
    CHECK(kernel_override(affine()) == nullptr);
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("an edited kernel that does not fit the host code is refused with the difference")
{
    const auto attempt = [](const std::string& body) {
        const Folder folder;
        make_kernel_folder(folder.path, body);
        const KernelDir variable(folder.path);
        return refusal([] { kernel_override(affine()); });
    };
    const auto refused = [&](const std::string& body, const char* word) {
        const Refusal found = attempt(body);
        INFO(found.text);
        CHECK(found.code == ErrorCode::kernel_compilation);
        CHECK(contains(found.text, word));
    };
    CHECK(attempt(kAffineText).code == std::nullopt);
    const std::string tail = "KERNEL(count) { x[i] = x[i] * factor + add; }\n";
    refused("PARAMS { uint count; float factor; float add; };\nUPDATE(0, float, x)\n" + tail, "affine.comp");
    refused("PARAMS { uint count; float factor; float shift; };\nUPDATE(0, float, x);\n"
            "KERNEL(count) { x[i] = x[i] * factor + shift; }\n",
            "shift");
    refused("PARAMS { uint count; float factor; float add; };\nUPDATE(0, vec2, x);\n" + tail, "binding 0");
    refused("PARAMS { uint count; float factor; float add; };\nUPDATE(0, float, x);\nREAD(1, float, y);\n"
            "KERNEL(count) { x[i] = x[i] * factor + add + y[i]; }\n",
            "binding 1");
    refused("PARAMS { uint count; float factor; float add; };\nUPDATE(0, float, x);\n"
            "GROUP_KERNEL(64) { PHASE_BEGIN x[group] = factor + add + float(count + lane); PHASE_END }\n",
            "GROUP_KERNEL");
}

TEST_CASE("TAUT_KERNEL_DIR must name a folder, with each kernel in it once")
{
    const Folder folder;
    {
        const KernelDir variable(folder.path / "none");
        CHECK(refusal([] { kernel_override(affine()); }).code == ErrorCode::io);
    }
    make_kernel_folder(folder.path, kAffineText);
    write_text(folder.path / "other" / "affine.comp", kAffineText);
    const KernelDir variable(folder.path);
    CHECK(refusal([] { kernel_override(affine()); }).code == ErrorCode::kernel_compilation);
    const KernelDir empty("");
    CHECK(kernel_override(affine()) == nullptr);
}

TEST_CASE("without a Vulkan driver the list is empty and opening says why")
{
    if (list_vulkan().empty())
        return;
    const Folder folder;
    const std::string none = (folder.path / "no_driver.json").string();
    const Variable old_name("VK_ICD_FILENAMES", none);
    const Variable new_name("VK_DRIVER_FILES", none);
    CHECK(list_vulkan().empty());
    const Refusal refused = refusal([] { open_vulkan(0, {}); });
    CHECK(refused.code == ErrorCode::no_device);
    CHECK(contains(refused.text, "driver"));
}

TEST_CASE("validation without the layers is refused with the package that has them")
{
    if (list_vulkan().empty())
        return;
    const Folder folder;
    const Variable path("VK_LAYER_PATH", folder.path.string());
    OpenOptions options;
    options.validation = true;
    const Refusal refused = refusal([&] { open_vulkan(0, options); });
    CHECK(refused.code == ErrorCode::unsupported);
    CHECK(contains(refused.text, "vulkan-validationlayers"));
}

TEST_CASE("wrong use of Vulkan is counted, and its text kept")
{
    TAUT_VULKAN_DEVICE(device);
    vulkan::Context& context = *vulkan::context_of(*device);
    VkBufferCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO; // size 0 and usage 0 are both wrong
    VkBuffer buffer = VK_NULL_HANDLE;
    context.vk.vkCreateBuffer(context.device, &info, nullptr, &buffer);
    context.vk.vkDestroyBuffer(context.device, buffer, nullptr);
    const std::vector<std::string> messages = validation_messages(*device);
    CHECK(device->counters().validation_messages >= 2);
    CHECK(messages.size() == device->counters().validation_messages);
    CHECK(std::any_of(messages.begin(), messages.end(),
                      [](const std::string& text) { return contains(text, "VkBufferCreateInfo"); }));
}

TEST_CASE("a barrier that was left out is seen by synchronisation validation")
{
    TAUT_VULKAN_DEVICE(device);
    static const auto produce = kernel_of("produce", "PARAMS { uint count; };\nWRITE(0, uint, x);\n"
                                                     "KERNEL(count) { x[i] = i; }\n");
    static const auto consume = kernel_of("consume", "PARAMS { uint count; };\nWRITE(0, uint, y);\n"
                                                     "READ(1, uint, x);\nKERNEL(count) { y[i] = x[i]; }\n");
    const BufferPtr x = device->make_buffer(256, "x");
    const BufferPtr y = device->make_buffer(256, "y");
    for (const bool barrier : {true, false})
    {
        const CountParams params = {64};
        const auto bytes = std::as_bytes(std::span(&params, 1));
        RecordingDesc desc;
        desc.buffers = {x, y};
        desc.dispatches.resize(2);
        desc.dispatches[0].kernel = &produce->info;
        desc.dispatches[0].bindings = {{0, 0, 256}};
        desc.dispatches[1].kernel = &consume->info;
        desc.dispatches[1].bindings = {{1, 0, 256}, {0, 0, 256}};
        for (Dispatch& dispatch : desc.dispatches)
        {
            dispatch.params.assign(bytes.begin(), bytes.end());
            dispatch.count = 64;
        }
        desc.barrier_before = {false, barrier};
        const std::uint64_t before = device->counters().validation_messages;
        device->compile(std::move(desc))->replay();
        device->wait();
        CHECK((device->counters().validation_messages == before) == barrier);
    }
    CHECK(contains(said(*device), "SYNC-HAZARD"));
}

TEST_CASE("a closed Vulkan device leaves nothing behind")
{
    std::shared_ptr<vulkan::ValidationLog> log;
    {
        const std::shared_ptr<Device> device = open_here();
        if (!device)
            return;
        log = vulkan::context_of(*device)->instance->log;
        const BufferPtr x = device->make_buffer(5000, "x");
        Recorder recorder(device);
        for (int i = 0; i < 10; ++i)
            recorder.dispatch(affine(), {x}, AffineParams{16, 1, 3}, 16);
        const auto recording = recorder.finish();
        for (int i = 0; i < 3; ++i)
            recording->replay();
        recording->replay_timed();
        recording->replay(); // still running when everything closes
    }
    INFO((log->texts().empty() ? std::string() : log->texts().front()));
    CHECK(log->count() == 0);
}

TEST_CASE("what a Vulkan device leaves behind would be seen")
{
    std::shared_ptr<vulkan::ValidationLog> log;
    {
        const std::shared_ptr<Device> device = open_here();
        if (!device)
            return;
        vulkan::Context& context = *vulkan::context_of(*device);
        log = context.instance->log;
        VkFenceCreateInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        VkFence forgotten = VK_NULL_HANDLE;
        context.vk.vkCreateFence(context.device, &info, nullptr, &forgotten);
    }
    CHECK(log->count() == 1);
}
