#include <zlg/logs/table_column.hpp>

#include <zlg/logs/angle_layout.hpp>
#include <zlg/logs/raw_layout.hpp>

#include "test.hpp"

namespace zlg::logs::table_column_test {

template <class T> using Values = std::vector<T>;

template <class Table> std::vector<std::string> names_of() {
    std::vector<std::string> names;
    for_each_column<Table>([&](const auto& column, std::size_t k) {
        EXPECT_EQ(k, names.size());
        names.emplace_back(column.name);
    });
    return names;
}

TEST(TableColumn, the_tables_name_every_column_once) {
    EXPECT_EQ(names_of<AngleTable>(), (std::vector<std::string>{"tick", "t_s", "dtheta_arcsec", "dtheta_final_arcsec",
                                                                "sigma_arcsec", "mode", "flags"}));
    const std::vector<std::string> raw = names_of<RawTable>();
    EXPECT_EQ(raw.size(), 15u);
    EXPECT_EQ(std::set<std::string>(raw.begin(), raw.end()).size(), raw.size());
    EXPECT_EQ(raw.front(), "half");
}

TEST(TableColumn, a_value_goes_into_a_row_and_comes_out_again) {
    RawTable::Row row;
    for_each_column<RawTable>([&]<class Column>(const Column& column, std::size_t k) {
        using Value = typename Column::Value;
        const auto value = std::is_same_v<typename Column::Rule, Flag> ? Value{1} : static_cast<Value>(k + 1);
        column.set(row, value);
        EXPECT_EQ(column.of(row), value) << column.name;
    });
    EXPECT_EQ(row.half, 1);
    EXPECT_EQ(row.span, 12);
    EXPECT_EQ(row.fringe, 13.0f);
    EXPECT_TRUE(row.late);
    EXPECT_TRUE(row.lit);
    AngleTable::Row angle;
    std::get<5>(AngleTable::columns).set(angle, std::int8_t{-1});
    EXPECT_EQ(angle.row.mode, -1);
}

TEST(TableColumn, an_optional_one_is_there_where_its_flag_says_so) {
    for_each_column<RawTable>([]<class Column>(const Column& column, std::size_t) {
        RawColumns none;
        EXPECT_EQ(column.is_in(none), !Column::is_optional) << column.name;
        if constexpr (Column::is_optional) {
            none.*column.is_there = true;
            EXPECT_TRUE(column.is_in(none)) << column.name;
        }
    });
}

TEST(TableColumn, parts_stand_beside_their_columns) {
    PartsOf<AngleTable, Values> values;
    for_each_column<AngleTable>(values,
                                [](const auto& column, auto& part, std::size_t k) { part.assign(k, column.absent); });
    EXPECT_EQ(std::get<0>(values).size(), 0u);
    EXPECT_EQ(std::get<6>(values).size(), 6u);
}

}  // namespace zlg::logs::table_column_test
