#include <zlg/logs/error.hpp>
#include <zlg/logs/file_nature.hpp>

#include "temporary_folder.hpp"

namespace zlg::logs::file_nature_test {

using namespace std::string_view_literals;

class FileNature : public ::testing::Test {
protected:
    std::string of(std::string_view bytes) {
        const std::string path = folder_.file("file");
        std::ofstream{path, std::ios::binary} << bytes;
        return foreign_nature(path);
    }
    std::string written(std::string_view bytes) {
        (void)of(bytes);
        return folder_.file("file");
    }

private:
    zlg::test::TemporaryFolder folder_;
};

std::string bytes_of(const std::vector<double>& values) {
    std::string bytes(values.size() * sizeof(double), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

TEST_F(FileNature, text_is_not_foreign) {
    EXPECT_EQ(of("1 2 3\n"), "");
    EXPECT_EQ(of(""), "");
    EXPECT_EQ(of("\xEF\xBB\xBFt;x\n"), "");
}

TEST_F(FileNature, files_of_other_programs_are_called_by_their_names) {
    EXPECT_EQ(of("\x93NUMPY\x01\0v\0"sv), "a NumPy array (.npy)");
    EXPECT_EQ(of("MATLAB 5.0 MAT-file, Platform: GLNXA64\0"sv), "a MATLAB 5 file (.mat)");
    EXPECT_EQ(of("PK\x03\x04\0"sv), "a ZIP archive, as .npz, .xlsx and .ods are");
    EXPECT_EQ(of("\xff\xfe"
                 "1\0,\0"sv),
              "text in UTF-16; save it as UTF-8");
    EXPECT_EQ(of("\x01\0\xff\x7f\x03"sv), "a binary file");
}

TEST_F(FileNature, hdf5_is_found_behind_a_user_block) {
    const std::string signature{"\x89HDF\r\n\x1a\n"};
    EXPECT_EQ(of(signature + "rest"), "HDF5");
    for (const std::size_t block : {512u, 1024u, 4096u})
        EXPECT_EQ(of(std::string(block, '\0') + signature + "rest"),
                  "HDF5 with a user block of " + std::to_string(block) + " bytes");
    EXPECT_EQ(of(std::string(700, '\0') + signature), "a binary file") << "not where HDF5 looks";
}

TEST_F(FileNature, rows_of_doubles_are_told_with_their_width) {
    std::vector<double> rows;
    for (int k = 0; k < 40; ++k) {
        rows.push_back(0.01 * k + 5.0);
        for (int c = 1; c < 7; ++c) rows.push_back(0.001 * ((k * 7919 + c * 104729) % 1000) - 0.5);
    }
    EXPECT_EQ(
        of(bytes_of(rows)),
        "binary numbers of 8 bytes without a header, by the look of them 7 to a row, the first of which rises evenly");
}

TEST_F(FileNature, what_is_no_text_is_refused_as_what_it_is) {
    const std::string path = written("\x93NUMPY\x01\0v\0"sv);
    EXPECT_EQ(zlg::test::message_of<FormatError>([&] { refuse_foreign(path); }),
              path + ": is a NumPy array (.npy); allowed is a text file; zlg import reads this one");
    EXPECT_THROW(refuse_foreign("/no/such/file"), IoError);
}

}  // namespace zlg::logs::file_nature_test
