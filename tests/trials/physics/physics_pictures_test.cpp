#include <zlg/trials/physics_pictures.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

namespace zlg::trials {
namespace {

const report::Figure& panel(const PhysicsPictures& made, std::string_view id) {
    for (const Picture& picture : made.pictures) {
        for (const report::Figure& figure : picture.panels) {
            if (figure.id == id) return figure;
        }
    }
    throw std::logic_error("no panel " + std::string{id});
}

double reading(const PhysicsPictures& made, const std::string& quantity) {
    for (const Reading& r : made.readings) {
        if (r.quantity == quantity) return std::stod(r.value);
    }
    throw std::logic_error("no reading " + quantity);
}

void expect_drawable(const report::Figure& figure, std::set<std::string>& ids) {
    EXPECT_TRUE(ids.insert(figure.id).second) << figure.id;
    EXPECT_FALSE(figure.x_label.empty()) << figure.id;
    EXPECT_FALSE(figure.y_label.empty()) << figure.id;
    EXPECT_FALSE(figure.caption.empty()) << figure.id;
    for (const report::Series& series : figure.series) {
        ASSERT_EQ(series.x.size(), series.y.size()) << figure.id;
        const auto n = std::count_if(series.y.begin(), series.y.end(), [](double y) { return std::isfinite(y); });
        EXPECT_GE(n, 2) << figure.id << " " << series.name;
    }
}

// In one test: each would compute all of them again.
TEST(PhysicsPictures, ShowWhatTheModelIsKnownFor) {
    const PhysicsPictures made = physics_pictures();
    std::set<std::string> names;
    std::set<std::string> ids;
    for (const Picture& picture : made.pictures) {
        EXPECT_TRUE(names.insert(picture.name).second) << picture.name;
        for (const report::Figure& figure : picture.panels) expect_drawable(figure, ids);
    }
    EXPECT_EQ(names.size(), 8U);

    // Published edges of the zones at 15 G.
    const auto& zones = panel(made, "waves").bands;
    ASSERT_EQ(zones.size(), 5U);
    const double edges[] = {0.201, 0.246, 0.255, 0.300};
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(zones[k].x1, edges[k], 0.002);

    // With even edges nothing is read in the zone; with dithered ones what was turned.
    const report::Figure& dead = panel(made, "dead-zone");
    for (std::size_t i = 0; i < dead.series[0].x.size(); ++i) {
        if (std::abs(dead.series[0].x[i]) < 0.9 * dead.bands[0].x1) EXPECT_NEAR(dead.series[0].y[i], 0.0, 0.02);
    }
    for (std::size_t i = 0; i < dead.series[1].x.size(); ++i) {
        EXPECT_NEAR(dead.series[1].y[i], dead.series[1].x[i], 0.05);
    }

    // The piezo as it was asked for, and a switch that is worth half a wavelength.
    EXPECT_NEAR(reading(made, "loop of the full range: width over height"), 0.12, 0.0015);
    EXPECT_NEAR(reading(made, "creep from 1 s to 100 s, a decade"), 1.5, 0.05);
    const report::Series& volts = panel(made, "switch-volts").series[0];
    EXPECT_NEAR(volts.y.back() - volts.y.front(), 40.0, 0.5);
    EXPECT_EQ(panel(made, "misses").series[0].x.size(), 10U);
}

TEST(PhysicsPictures, StackTheirPanelsOnAGroundOfTheReadersMode) {
    report::Figure figure{.id = "a",
                          .title = "t",
                          .caption = "c",
                          .x_label = "x, s",
                          .y_label = "y, m",
                          .series = {{.name = "s", .x = {0.0, 1.0}, .y = {0.0, 1.0}, .y_error = {}}},
                          .bands = {}};
    const std::string one = svg_file(Picture{"one", {figure}});
    const std::string two = svg_file(Picture{"two", {figure, figure}});
    const auto height = [](const std::string& svg) {
        const std::string key = "height=\"";
        return std::atof(svg.c_str() + svg.find(key) + key.size());
    };
    EXPECT_GT(height(one), 300.0);
    EXPECT_NEAR(height(two), 2.0 * height(one), 0.02);
    const std::size_t ground = one.find("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>");
    ASSERT_NE(ground, std::string::npos);
    EXPECT_LT(ground, one.find("<path"));
    EXPECT_NE(one.find("prefers-color-scheme:dark"), std::string::npos);
    EXPECT_NEAR(std::atof(two.c_str() + two.rfind("<svg y=\"") + 8), height(one), 0.02);
    EXPECT_EQ(one.find("<svg y=\"0\""), one.rfind("<svg y="));
}

TEST(PhysicsPictures, WriteTheirNumbersAsATable) {
    EXPECT_EQ(markdown({{"length", "2.5", "m"}, {"ratio", "3", ""}}),
              "| quantity | value | unit |\n|---|---|---|\n| length | 2.5 | m |\n| ratio | 3 |  |\n");
}

}  // namespace
}  // namespace zlg::trials
