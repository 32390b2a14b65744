#include "taut/runtime/vulkan/instance.hpp"

#include "taut/runtime/vulkan/result.hpp"
#include "taut/runtime/vulkan/structs.hpp"
#include "taut/runtime/vulkan/volk.hpp"

#include <algorithm>
#include <cstring>

namespace taut::vulkan {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kPortability = "VK_KHR_portability_enumeration";
constexpr VkInstanceCreateFlags kEnumeratePortability =
    0x1; // VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR
constexpr std::size_t kKeptTexts = 1000;

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* log)
{
    std::string text = data->pMessage;
    if (data->pMessageIdName != nullptr && text.find(data->pMessageIdName) == std::string::npos)
        text = std::string(data->pMessageIdName) + ": " + text; // newer layers leave it out of the text
    static_cast<ValidationLog*>(log)->add(text.c_str());
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(ValidationLog& log)
{
    auto info =
        start<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    // General messages are the loader's remarks about the machine, not about our calls.
    info.messageType =
        VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = on_message;
    info.pUserData = &log;
    return info;
}

template <typename Function>
Function find(PFN_vkGetInstanceProcAddr loader, VkInstance instance, const char* name)
{
    return reinterpret_cast<Function>(loader(instance, name));
}

void load(Instance& instance)
{
    InstanceTable& t = instance.table;
#define TAUT_LOAD(name)                                                                                      \
    t.name = find<PFN_vk##name>(instance.loader, instance.handle, "vk" #name);                               \
    if (t.name == nullptr)                                                                                   \
        throw Error(ErrorCode::bad_input, "the Vulkan loader gives no function vk" #name                     \
                                          " for this instance; it must be of Vulkan 1.1 or later");
    TAUT_INSTANCE_FUNCTIONS(TAUT_LOAD)
#undef TAUT_LOAD
    t.CreateDebugUtilsMessengerEXT = find<PFN_vkCreateDebugUtilsMessengerEXT>(
        instance.loader, instance.handle, "vkCreateDebugUtilsMessengerEXT");
    t.DestroyDebugUtilsMessengerEXT = find<PFN_vkDestroyDebugUtilsMessengerEXT>(
        instance.loader, instance.handle, "vkDestroyDebugUtilsMessengerEXT");
    t.SetDebugUtilsObjectNameEXT = find<PFN_vkSetDebugUtilsObjectNameEXT>(instance.loader, instance.handle,
                                                                          "vkSetDebugUtilsObjectNameEXT");
}

bool has_extension(PFN_vkGetInstanceProcAddr loader, const char* layer, const char* name)
{
    const auto enumerate = find<PFN_vkEnumerateInstanceExtensionProperties>(
        loader, VK_NULL_HANDLE, "vkEnumerateInstanceExtensionProperties");
    std::uint32_t count = 0;
    if (enumerate(layer, &count, nullptr) != VK_SUCCESS)
        return false;
    std::vector<VkExtensionProperties> all(count);
    if (enumerate(layer, &count, all.data()) < VK_SUCCESS)
        return false;
    return std::any_of(all.begin(), all.end(), [&](const VkExtensionProperties& e) {
        return std::strcmp(e.extensionName, name) == 0;
    });
}

void require_validation(PFN_vkGetInstanceProcAddr loader)
{
    const auto enumerate = find<PFN_vkEnumerateInstanceLayerProperties>(loader, VK_NULL_HANDLE,
                                                                        "vkEnumerateInstanceLayerProperties");
    std::uint32_t count = 0;
    check(enumerate(&count, nullptr), "vkEnumerateInstanceLayerProperties");
    std::vector<VkLayerProperties> layers(count);
    check(enumerate(&count, layers.data()), "vkEnumerateInstanceLayerProperties");
    const bool found = std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& l) {
        return std::strcmp(l.layerName, kValidationLayer) == 0;
    });
    if (!found || !has_extension(loader, kValidationLayer, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME) ||
        !has_extension(loader, nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME))
        throw Error(ErrorCode::unsupported, std::string("validation needs the layer ") + kValidationLayer +
                                                ", which is not installed; install the package "
                                                "vulkan-validationlayers (Debian, Ubuntu)");
}

std::uint32_t instance_version(PFN_vkGetInstanceProcAddr loader)
{
    const auto ask =
        find<PFN_vkEnumerateInstanceVersion>(loader, VK_NULL_HANDLE, "vkEnumerateInstanceVersion");
    std::uint32_t version = VK_API_VERSION_1_0;
    if (ask == nullptr || ask(&version) != VK_SUCCESS || version < VK_API_VERSION_1_1)
        throw Error(ErrorCode::no_device,
                    "the Vulkan loader is older than Vulkan 1.1; install a newer libvulkan1");
    return version;
}

/// Everything that vkCreateInstance points to, kept in one place while it is called.
struct Wish
{
    explicit Wish(PFN_vkGetInstanceProcAddr loader, ValidationLog* log)
    {
        app.pApplicationName = "taut";
        app.pEngineName = "taut";
        app.apiVersion = std::min<std::uint32_t>(instance_version(loader), VK_API_VERSION_1_3);
        info.pApplicationInfo = &app;
        if (has_extension(loader, nullptr, kPortability))
        {
            extensions.push_back(kPortability);
            info.flags |= kEnumeratePortability;
        }
        if (log != nullptr)
            add_validation(loader, *log);
        info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
        info.ppEnabledExtensionNames = extensions.data();
    }

    Wish(const Wish&) = delete;
    Wish& operator=(const Wish&) = delete;

    void add_validation(PFN_vkGetInstanceProcAddr loader, ValidationLog& log)
    {
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
        messenger = messenger_info(log);
        features.pNext = &messenger;
        features.enabledValidationFeatureCount = 1;
        features.pEnabledValidationFeatures = &synchronization;
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &layer;
        watch_shaders(loader);
    }

    /// Newer layers look at what shaders read and write only when they are asked to.
    void watch_shaders([[maybe_unused]] PFN_vkGetInstanceProcAddr loader)
    {
#ifdef VK_EXT_layer_settings
        if (!has_extension(loader, kValidationLayer, VK_EXT_LAYER_SETTINGS_EXTENSION_NAME))
            return;
        extensions.push_back(VK_EXT_LAYER_SETTINGS_EXTENSION_NAME);
        settings.settingCount = 1;
        settings.pSettings = &shader_accesses;
        settings.pNext = info.pNext;
        info.pNext = &settings;
#endif
    }

    VkApplicationInfo app = start<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    VkInstanceCreateInfo info = start<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    VkValidationFeaturesEXT features =
        start<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
    VkDebugUtilsMessengerCreateInfoEXT messenger = {};
    VkValidationFeatureEnableEXT synchronization =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
#ifdef VK_EXT_layer_settings
    VkBool32 yes = VK_TRUE;
    VkLayerSettingEXT shader_accesses = {kValidationLayer, "syncval_shader_accesses_heuristic",
                                         VK_LAYER_SETTING_TYPE_BOOL32_EXT, 1, &yes};
    VkLayerSettingsCreateInfoEXT settings =
        start<VkLayerSettingsCreateInfoEXT>(VK_STRUCTURE_TYPE_LAYER_SETTINGS_CREATE_INFO_EXT);
#endif
    std::vector<const char*> extensions;
    const char* layer = kValidationLayer;
};

} // namespace

void ValidationLog::add(const char* text)
{
    const std::lock_guard lock(mutex_);
    ++count_;
    if (texts_.size() < kKeptTexts)
        texts_.emplace_back(text);
}

std::uint64_t ValidationLog::count() const
{
    const std::lock_guard lock(mutex_);
    return count_;
}

std::vector<std::string> ValidationLog::texts() const
{
    const std::lock_guard lock(mutex_);
    return texts_;
}

std::shared_ptr<Instance> Instance::create(bool validation)
{
    auto instance = std::make_shared<Instance>();
    instance->loader = system_loader();
    if (instance->loader == nullptr)
        throw Error(
            ErrorCode::no_device,
            "there is no Vulkan loader (libvulkan.so.1); install the package libvulkan1 and a driver");
    if (validation)
    {
        require_validation(instance->loader);
        instance->log = std::make_shared<ValidationLog>();
    }
    const Wish wish(instance->loader, instance->log.get());
    const auto make = find<PFN_vkCreateInstance>(instance->loader, VK_NULL_HANDLE, "vkCreateInstance");
    check(make(&wish.info, nullptr, &instance->handle), "vkCreateInstance");
    instance->owned_ = true;
    load(*instance);
    if (validation)
    {
        const VkDebugUtilsMessengerCreateInfoEXT info = messenger_info(*instance->log);
        check(instance->table.CreateDebugUtilsMessengerEXT(instance->handle, &info, nullptr,
                                                           &instance->messenger_),
              "vkCreateDebugUtilsMessengerEXT");
    }
    return instance;
}

std::shared_ptr<Instance> Instance::borrow(VkInstance handle, PFN_vkGetInstanceProcAddr loader)
{
    auto instance = std::make_shared<Instance>();
    instance->handle = handle;
    instance->loader = loader;
    load(*instance);
    // The host may not have enabled the extension although its loader knows the name.
    instance->table.SetDebugUtilsObjectNameEXT = nullptr;
    return instance;
}

Instance::~Instance()
{
    if (!owned_ || table.DestroyInstance == nullptr)
        return;
    if (messenger_ != VK_NULL_HANDLE)
        table.DestroyDebugUtilsMessengerEXT(handle, messenger_, nullptr);
    table.DestroyInstance(handle, nullptr);
}

} // namespace taut::vulkan
