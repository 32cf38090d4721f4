// The range of every number is that of the text that documents it.
#include "schema_support.hpp"

#include <regex>

namespace zlg::config::schema_ranges_test {

// What a text such as `above 0 up to 1e9` allows.
struct Range {
    std::optional<double> min, max;
    bool has_min = true, has_max = true;  // the end itself is allowed
};

std::optional<Range> range_of(const std::string& allowed) {
    const std::string number = "(-?[0-9]+(?:[.][0-9]+)?(?:e-?[0-9]+)?)";
    const auto matches = [&](const std::string& form, std::smatch& found) {
        return std::regex_match(allowed, found, std::regex{form});
    };
    std::smatch m;
    if (matches(number + "[.][.]" + number, m)) return Range{std::stod(m[1]), std::stod(m[2])};
    if (matches("above " + number + " up to " + number, m)) return Range{std::stod(m[1]), std::stod(m[2]), false};
    if (matches("above " + number + " to below " + number, m))
        return Range{std::stod(m[1]), std::stod(m[2]), false, false};
    if (matches("from " + number + " to below " + number, m))
        return Range{std::stod(m[1]), std::stod(m[2]), true, false};
    if (matches("from " + number, m)) return Range{.min = std::stod(m[1])};
    if (matches("above " + number, m)) return Range{.min = std::stod(m[1]), .has_min = false};
    return std::nullopt;
}

bool is_allowed(const KeyInfo& key, double value) {
    std::ostringstream text;
    text.precision(17);
    if (key.kind == ValueKind::integer)
        text << static_cast<std::int64_t>(value);
    else
        text << value;
    return test::refusal_by<ConfigError>([&] { (void)with({key.section + "." + key.name + "=" + text.str()}); })
        .empty();
}

// Every key whose text names a range: its ends belong to it or not as the text says, and nothing beyond them does.
TEST(Schema, TheEndsOfARangeAreThoseOfItsText) {
    constexpr double largest_whole = 9007199254740992.0;  // 2^53: beyond, the neighbour of an integer is no double
    int n_ranges = 0;
    for (const KeyInfo& key : describe_keys()) {
        const std::optional<Range> range = range_of(key.allowed);
        if (!range) continue;
        ++n_ranges;
        const auto step = [&](double end) {
            return key.kind == ValueKind::integer ? 1.0 : std::max(1e-3 * std::abs(end), 1e-9);
        };
        const std::string what = key.section + "." + key.name + ": " + key.allowed;
        if (range->min) {
            EXPECT_EQ(is_allowed(key, *range->min), range->has_min) << what;
            EXPECT_FALSE(is_allowed(key, *range->min - step(*range->min))) << what;
        }
        if (range->max && *range->max < largest_whole) {
            EXPECT_EQ(is_allowed(key, *range->max), range->has_max) << what;
            EXPECT_FALSE(is_allowed(key, *range->max + step(*range->max))) << what;
        }
    }
    EXPECT_GT(n_ranges, 70);
}

TEST(Schema, ColumnsListsAndIntervalsHaveEndsToo) {
    for (const std::string_view good : {"motion.column=1", "motion.frequency_hz=0", "drift.magnetic_arcsec_s=-1e300"})
        EXPECT_NO_THROW(with({good})) << good;
    for (const std::string_view bad : {"motion.column=0", "motion.rate_hz=0", "switching.interval_s=0"})
        EXPECT_THROW(with({bad}), ConfigError) << bad;
}

// Keys that take numbers are those whose default is no quoted text.
bool takes_numbers(const KeyInfo& key) { return key.default_text.find_first_of("\"") == std::string::npos; }

TEST(Schema, NoKeyTakesNanOrInfinity) {
    for (const KeyInfo& key : describe_keys()) {
        if (!takes_numbers(key)) continue;
        for (const std::string value : {"nan", "inf", "-inf"}) {
            EXPECT_THROW(with({key.section + "." + key.name + "=" + value}), ConfigError) << key.name;
        }
    }
    Config c;
    c.gyro.bias_chi = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(complaint([&] { check(c); }), "gyro.bias_chi = nan: allowed is -1e6..1e6");
}

TEST(Schema, TheTableSaysWhatIsAllowedOfANumberOfEitherSignAndOfZeroOrMore) {
    Config c;
    for (const char* good : {"1e-6", "-1e-6", "1e6", "-1e6", "0.3"})
        EXPECT_NO_THROW(apply_pair(c, "gyro.discriminator_per_lambda", good, "test")) << good;
    for (const char* bad : {"0", "9e-7", "-9e-7", "1.1e6", "-1.1e6"})
        expect_contains(complaint([&] { apply_pair(c, "gyro.discriminator_per_lambda", bad, "test"); }),
                        "allowed is 1e-6..1e6 or -1e6..-1e-6");
    for (const char* good : {"0", "-0.0", "100", "1e6"})
        EXPECT_NO_THROW(apply_pair(c, "piezo.mirror_hz", good, "test")) << good;
    for (const char* bad : {"1e-300", "99.9", "-1", "1.1e6"})
        expect_contains(complaint([&] { apply_pair(c, "piezo.mirror_hz", bad, "test"); }), "allowed is 0 or 100..1e6");
}

}  // namespace zlg::config::schema_ranges_test
