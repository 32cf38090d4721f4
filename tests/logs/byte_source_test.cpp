#include <zlg/logs/byte_source.hpp>
#include <zlg/logs/error.hpp>

#include "temporary_folder.hpp"

namespace zlg::logs::byte_source_test {

TEST(ByteSource, GivesTheBytesOfAFileAndItsEnd) {
    const test::TemporaryFolder folder;
    const std::string path = folder.file("line.bin");
    std::ofstream{path, std::ios::binary} << std::string("\0ab\xff", 4);
    ByteSource source{path, 921600};
    std::array<std::uint8_t, 3> buffer{};
    std::size_t n = 0;
    ASSERT_EQ(source.read(buffer, n, 1000), ByteSource::Read::bytes);
    EXPECT_EQ(n, 3u);
    EXPECT_EQ(buffer, (std::array<std::uint8_t, 3>{0, 'a', 'b'}));
    ASSERT_EQ(source.read(buffer, n, 1000), ByteSource::Read::bytes);
    EXPECT_EQ(n, 1u);
    EXPECT_EQ(buffer[0], 0xff);
    EXPECT_EQ(source.read(buffer, n, 1000), ByteSource::Read::end);
}

TEST(ByteSource, SaysWhatNoSourceIs) {
    const test::TemporaryFolder folder;
    const std::string path = folder.file("line.bin");
    std::ofstream{path} << "a";
    EXPECT_THROW((ByteSource{path, 12345}), SourceError);
    EXPECT_THROW((ByteSource{"tcp:nowhere", 921600}), SourceError);
    EXPECT_THROW((ByteSource{"tcp::80", 921600}), SourceError);
    EXPECT_THROW((ByteSource{"unix:", 921600}), SourceError);
    EXPECT_THROW((ByteSource{"unix:" + std::string(200, 'a'), 921600}), SourceError);
    EXPECT_THROW((ByteSource{folder.file("absent"), 921600}), IoError);
    EXPECT_THROW((ByteSource{folder.file(""), 921600}), IoError);
}

}  // namespace zlg::logs::byte_source_test
