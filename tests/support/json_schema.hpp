#pragma once
// A JSON Schema that JSON is held against, by valijson.

#include <nlohmann/json.hpp>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#endif
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#include <string>

namespace taut {

class JsonSchema
{
public:
    /// Throws where it is not a schema.
    explicit JsonSchema(const nlohmann::json& text)
    {
        const valijson::adapters::NlohmannJsonAdapter adapter(text);
        valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(adapter, schema_);
    }

    /// What is wrong with `json`, a line for each fault; empty where nothing is.
    std::string faults(const nlohmann::json& json) const
    {
        const valijson::adapters::NlohmannJsonAdapter adapter(json);
        valijson::ValidationResults results;
        valijson::Validator validator;
        if (validator.validate(schema_, adapter, &results))
            return {};
        std::string out;
        for (valijson::ValidationResults::Error error; results.popError(error);)
        {
            for (const std::string& part : error.context)
                out += part;
            out += ": " + error.description + '\n';
        }
        return out;
    }

private:
    valijson::Schema schema_;
};

} // namespace taut
