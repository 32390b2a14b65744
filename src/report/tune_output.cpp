// What a search found, as JSON.
#include "taut/report/method_settings.hpp"
#include "taut/report/number_or_null.hpp"
#include "taut/report/tune.hpp"
#include "taut/version.hpp"

#include <nlohmann/json.hpp>

namespace taut {
namespace {

using Json = nlohmann::ordered_json;

Json rejections(const TuneResult& result)
{
    Json out = Json::array();
    for (const TuneRejection& rejection : result.rejected)
        out.push_back({{"method", Json::parse(settings_block(rejection.settings))},
                       {"stage", rejection.stage},
                       {"reason", rejection.reason},
                       {"error", number_or_null(rejection.error)}});
    return out;
}

Json blocks(const std::vector<MethodSettings>& settings)
{
    Json out = Json::array();
    for (const MethodSettings& one : settings)
        out.push_back(Json::parse(settings_block(one)));
    return out;
}

Json left(const TuneResult& result)
{
    Json out = Json::array();
    for (const TuneLeft& one : result.not_tried)
        out.push_back({{"method", Json::parse(settings_block(one.settings))}, {"reason", one.reason}});
    return out;
}

} // namespace

std::string tune_json(const TuneResult& result)
{
    const auto only_found = [&](const Json& value) { return result.found ? value : Json(nullptr); };
    Json json = {{"taut", TAUT_VERSION}, {"scene", result.scene}};
    json["device"] = result.device.name;
    json["executor"] = result.device.executor;
    json["driver"] = result.device.driver;
    json["found"] = result.found;
    json["answer"] = to_string(result.answer);
    json["why"] = result.why.empty() ? Json(nullptr) : Json(result.why);
    json["error_bound"] = result.bound;
    json["error_metric"] = result.metric;
    json["kind"] = result.kind == CostKind::at_rest ? "static" : "moving";
    json["frames"] = result.frames;
    json["reference"] = {{"class", result.reference.name},
                         {"text", result.reference.text},
                         {"error", number_or_null(result.reference.error)},
                         {"passed_over", result.reference.passed}};
    json["method"] = result.found ? Json::parse(settings_block(result.settings)) : Json(nullptr);
    json["predicted_error"] = only_found(result.predicted_error);
    json["confirmed_error"] = only_found(result.confirmed_error);
    json["starts"] = result.starts;
    json["predicted_ms_per_simulated_second"] = only_found(result.predicted_ms);
    json["ms_per_simulated_second"] = number_or_null(result.ms);
    json["cpu_ms_per_simulated_second"] = number_or_null(result.cpu_ms);
    json["kept"] = result.kept;
    json["rejected"] = rejections(result);
    json["tried"] = blocks(result.tried);
    json["not_tried"] = left(result);
    json["notes"] = result.notes;
    json["status"] = to_string(result.interrupted ? Status::interrupted : Status::completed);
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace taut
