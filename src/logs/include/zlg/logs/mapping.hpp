#pragma once
// What a file of another program means: pairs of key and text, said on the command line or in a file of TOML.

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace zlg::logs {

// The file alone does not say what it means: the line names the keys that are missing and what they may hold.
struct MappingError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class Mapping {
public:
    // `key = value`, `where` for the message. A list of columns has commas between them.
    //
    // errors  MappingError: no such key (the nearest one is named), a value that it does not take.
    void set(const std::string& key, const std::string& value, const std::string& where);

    [[nodiscard]] bool has(std::string_view key) const;
    // Empty where it is not set.
    [[nodiscard]] std::string text(std::string_view key) const;
    [[nodiscard]] std::optional<double> real(std::string_view key) const;
    [[nodiscard]] std::vector<std::string> axes() const { return axes_; }
    // What is set.
    [[nodiscard]] std::vector<std::string> keys_set() const;
    // The columns that hold something of a raw log.
    [[nodiscard]] std::vector<std::string> raw_columns() const;
    void set_axes(std::vector<std::string> axes) { axes_ = std::move(axes); }

    // As TOML, a line a key, in the order of the table of keys.
    [[nodiscard]] std::string toml() const;

private:
    std::map<std::string, std::string, std::less<>> values_;
    std::vector<std::string> axes_;
};

// errors  MappingError: no TOML, an unknown key, a wrong value; IoError.
void apply_mapping_file(Mapping& mapping, const std::string& path);

// "key=value" of a command line. errors  MappingError.
void apply_mapping_pair(Mapping& mapping, const std::string& pair);

// Every key with what it takes, a line each, for people.
[[nodiscard]] std::string mapping_keys_text();

// The keys that name a column of a raw log.
[[nodiscard]] std::vector<std::string> raw_keys();
[[nodiscard]] bool is_raw_key(std::string_view key);

// Of "always:1" and "alternating:-1", which stand for a column of a raw log, the number; empty: it is a column.
[[nodiscard]] std::optional<double> fixed_value(std::string_view said);

}  // namespace zlg::logs
