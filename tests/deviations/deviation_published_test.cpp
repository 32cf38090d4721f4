// The deviations of published sets of numbers.

#include <zlg/deviations/deviation.hpp>

#include "nbs14.hpp"
#include "records.hpp"

namespace zlg::deviations::deviation_published_test {

double deviation_of(const AngleRecord& record, DeviationKind kind, std::int64_t m) {
    const std::array factors{m};
    return deviation(record, kind, factors, {.noise = 0}).points.at(0).as_computed;
}

struct Published {
    DeviationKind kind;
    std::vector<double> value;
};

// A unit of the last of so many printed digits: some of the printed numbers are cut, not rounded.
double last_digit(double value, int digits) { return std::pow(10.0, std::ceil(std::log10(value)) - digits); }

// NBS Monograph 140, Annex 8.E; NIST Special Publication 1065, table 30. Total deviation: of doubly reflected phase.
TEST(DeviationPublished, gives_the_published_values_of_the_nine_point_set) {
    const auto record = record_of(nbs14_small());
    const std::vector<Published> table{
        {DeviationKind::adev, {91.22945, 115.8082}},  {DeviationKind::oadev, {91.22945, 85.95287}},
        {DeviationKind::mdev, {91.22945, 74.78849}},  {DeviationKind::tdev, {52.67135, 86.35831}},
        {DeviationKind::hdev, {70.80607, 116.7980}},  {DeviationKind::ohdev, {70.80607, 85.61487}},
        {DeviationKind::totdev, {91.22945, 93.90379}}};
    for (const auto& row : table)
        for (std::size_t k = 0; k < 2; ++k) {
            const auto m = static_cast<std::int64_t>(k + 1);
            EXPECT_NEAR(deviation_of(record, row.kind, m), row.value[k], last_digit(row.value[k], 7))
                << name_of(row.kind) << " m " << m;
        }
}

// The same publication, table 31.
TEST(DeviationPublished, gives_the_published_values_of_the_thousand_point_set) {
    const auto record = record_of(nbs14_large());
    const std::vector<Published> table{{DeviationKind::adev, {2.922319e-01, 9.965736e-02, 3.897804e-02}},
                                       {DeviationKind::oadev, {2.922319e-01, 9.159953e-02, 3.241343e-02}},
                                       {DeviationKind::mdev, {2.922319e-01, 6.172376e-02, 2.170921e-02}},
                                       {DeviationKind::tdev, {1.687202e-01, 3.563623e-01, 1.253382e-00}},
                                       {DeviationKind::hdev, {2.943883e-01, 1.052754e-01, 3.910860e-02}},
                                       {DeviationKind::ohdev, {2.943883e-01, 9.581083e-02, 3.237638e-02}},
                                       {DeviationKind::totdev, {2.922319e-01, 9.134743e-02, 3.406530e-02}}};
    for (const auto& row : table)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t m = k == 0 ? 1 : k == 1 ? 10 : 100;
            EXPECT_NEAR(deviation_of(record, row.kind, m), row.value[k], last_digit(row.value[k], 7))
                << name_of(row.kind) << " m " << m;
        }
}

// To twelve digits, by an independent implementation (AllanTools 2024.06) of the same set.
TEST(DeviationPublished, agrees_with_an_independent_implementation_to_all_digits) {
    const auto record = record_of(nbs14_large());
    const std::vector<Published> table{{DeviationKind::adev, {0.292231878107, 0.0996573606317, 0.038978043308}},
                                       {DeviationKind::oadev, {0.292231878107, 0.0915995342012, 0.0324134302606}},
                                       {DeviationKind::mdev, {0.292231878107, 0.0617237638245, 0.0217092091369}},
                                       {DeviationKind::totdev, {0.292231878107, 0.091347432617, 0.0340653025218}},
                                       {DeviationKind::hdev, {0.294388329124, 0.105275419401, 0.0391086055975}},
                                       {DeviationKind::ohdev, {0.294388329124, 0.0958108317325, 0.0323763825276}},
                                       {DeviationKind::tdev, {0.168720153491, 0.356362316595, 1.25338177391}}};
    for (const auto& row : table)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t m = k == 0 ? 1 : k == 1 ? 10 : 100;
            EXPECT_NEAR(deviation_of(record, row.kind, m), row.value[k], last_digit(row.value[k], 12))
                << name_of(row.kind) << " m " << m;
        }
}

}  // namespace zlg::deviations::deviation_published_test
