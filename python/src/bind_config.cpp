#include <pybind11/stl.h>

#include <zlg/config/log_settings.hpp>
#include <zlg/config/schema.hpp>

#include "bind.hpp"

namespace zlg::python {

namespace py = pybind11;

namespace {

py::list keys() {
    py::list all;
    for (const config::KeyInfo& key : config::describe_keys()) {
        py::dict info;
        info["section"] = key.section;
        info["name"] = key.name;
        info["unit"] = key.unit;
        info["meaning"] = key.meaning;
        info["default"] = key.default_text;
        info["allowed"] = key.allowed;
        info["kind"] = config::value_kind_names.at(static_cast<std::size_t>(key.kind));
        info["choices"] = key.choices;
        all.append(info);
    }
    return all;
}

// As --set of the program, whose name nobody has typed here.
void apply_setting(config::Config& config, const std::string& setting) {
    const auto equals = setting.find('=');
    if (equals == std::string::npos)
        throw config::ConfigError{"zlg.Config: " + setting +
                                  ": \"section.key=value\" is wanted, an equals sign is missing"};
    config::apply_pair(config, setting.substr(0, equals), setting.substr(equals + 1), "zlg.Config");
}

// Only the end is checked: what stands between members and `sets` need not be allowed.
config::Config of_pairs(const config::Settings& settings, const std::vector<std::string>& sets) {
    config::Config config;
    for (const auto& [key, value] : settings) config::apply_pair(config, key, value, "zlg.Config");
    for (const std::string& set : sets) apply_setting(config, set);
    config::check(config);
    return config;
}

config::Config of_layers(const std::string& toml, const std::string& source, const std::vector<std::string>& sets) {
    config::Config config;
    config::apply_toml(config, toml, source);
    for (const std::string& set : sets) apply_setting(config, set);
    config::check(config);
    return config;
}

config::Config of_log(const config::Settings& settings, const std::string& name) {
    config::Config config;
    config::apply_log(config, config::checked_log_settings(settings, name), name);
    return config;
}

}  // namespace

void bind_config(py::module_& m) {
    py::class_<config::Config>(m, "CheckedConfig")
        .def(py::init(&of_pairs), "settings"_a, "sets"_a = std::vector<std::string>{})
        .def_static("of_layers", &of_layers)
        .def_static("of_log", &of_log)
        .def("given", [](const config::Config& c) { return std::vector<std::string>(c.given.begin(), c.given.end()); })
        .def("toml", &config::to_toml)
        .def("settings", &config::to_settings);
    m.def("config_keys", &keys);
}

}  // namespace zlg::python
