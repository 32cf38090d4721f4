#include "foreign/npy_head.hpp"
#include "test.hpp"

namespace zlg::logs::npy_head_test {

using Shape = std::vector<std::size_t>;

TEST(NpyHead, any_spelling_of_python_is_read) {
    for (const char* text : {"{'descr': '<f8', 'fortran_order': True, 'shape': (8, 3), }   \n",
                             "{\"shape\":(8,3,),'fortran_order':True,\n'descr'  :\"<f8\"}",
                             " {'fortran_order':  True , 'descr':\t'<f8','shape' : ( 8 , 3 ) }"}) {
        const auto head = npy_head(text);
        ASSERT_TRUE(head) << text;
        EXPECT_EQ(head->descr, "<f8");
        EXPECT_TRUE(head->fortran_order);
        EXPECT_EQ(head->shape, (Shape{8, 3}));
    }
    EXPECT_EQ(npy_head("{'descr': '|u1', 'fortran_order': False, 'shape': (8,)}")->shape, Shape{8});
    EXPECT_EQ(npy_head("{'descr': '|u1', 'fortran_order': False, 'shape': ()}")->shape, Shape{});
}

TEST(NpyHead, what_numpy_does_not_read_or_reads_otherwise_is_refused) {
    for (const char* text : {"", "{", "{}", "{'descr': '<f8', 'fortran_order': True}",
                             "{'descr': '<f8', 'fortran_order': 1, 'shape': (8,)}",
                             "{'descr': '<f8', 'fortran_order': Trueish, 'shape': (8,)}",
                             "{'descr': '<f8', 'fortran_order': True, 'shape': (8)}",
                             "{'descr': '<f8', 'fortran_order': True, 'shape': (8,), 'shape': (9,)}",
                             "{'descr': '<f8', 'fortran_order': True, 'shape': (8,), 'more': 1}",
                             "{'descr': [('a', '<f8')], 'fortran_order': True, 'shape': (8,)}",
                             "{'descr': '<f8' '', 'fortran_order': True, 'shape': (8,)}",
                             "{'descr': '\\x3cf8', 'fortran_order': True, 'shape': (8,)}",
                             "{'descr': '<f8', 'fortran_order': not True, 'shape': (8,)}",
                             "{'descr': '<f8', 'fortran_order': True, 'shape': (8,,)}",
                             "{'descr': '<f8', 'fortran_order': True, 'shape': (,)}",
                             "{'descr': '<f8', 'fortran_order': True, 'shape': (-8,)}",
                             "{'descr': '<f8', 'fortran_order': True, 'shape': (08,)}",
                             "{'descr': '<f8', 'fortran_order': True, 'shape': (99999999999999999999999,)}",
                             "{'descr': '<f8', 'fortran_order': True, 'shape': (8,)} or {}"})
        EXPECT_FALSE(npy_head(text)) << text;
}

TEST(NpyHead, sixty_thousand_blanks_are_only_long) {
    const std::string blanks(60'000, ' ');
    EXPECT_TRUE(npy_head("{'descr':" + blanks + "'<f8', 'fortran_order': False, 'shape': (8,), }"));
    EXPECT_FALSE(npy_head("{'descr':" + blanks));
}

}  // namespace zlg::logs::npy_head_test
