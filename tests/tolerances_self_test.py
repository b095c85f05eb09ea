#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of tolerances.py on small texts."""
import unittest

import tolerances


def found(text):
    return [(tolerance, is_bare) for _, tolerance, is_bare in tolerances.literals(text)]


class Tolerances(unittest.TestCase):
    def bare(self, tolerance, text):
        self.assertEqual(found(text), [(tolerance, True)], text)

    def reasoned(self, text):
        self.assertFalse(any(is_bare for _, is_bare in found(text)), text)

    def test_a_number_alone_or_times_a_scale_is_bare(self):
        self.bare("1e-9", 'EXPECT_NEAR(x, f(1, "a, b)"), 1e-9) << "why";')
        self.bare("1", "ASSERT_NEAR(x, 314, 1);")
        self.bare("0.01 * size", "EXPECT_NEAR(x,\n            y,\n            0.01 * size);")
        self.bare("1e-12L", "EXPECT_LT(norm(a - b), 1e-12L);")
        self.bare("2 * bound + 1e-15", "ASSERT_LE(x, 2 * bound + 1e-15);")

    def test_a_limit_is_no_tolerance(self):
        for text in ("EXPECT_LT(share, 0.9);", "EXPECT_LE(x, 100 * bound);", "EXPECT_NEAR(x, y, 3 * bound);", "EXPECT_GT(x, 1e-9);",
                     '// EXPECT_NEAR(x, y, 1e-9);\nsay("EXPECT_NEAR(x, y, 1e-9)");'):
            self.assertEqual(found(text), [], text)

    def test_a_comment_in_its_lines_or_before_them_is_a_reason(self):
        self.reasoned("EXPECT_NEAR(x, y, 1e-9);  // nine digits are printed")
        self.reasoned("// Nine digits are printed.\nEXPECT_NEAR(x, y,\n  1e-9);")
        self.reasoned("EXPECT_NEAR(x, y,  /* printed */\n  1e-9);")
        self.bare("1e-9", "EXPECT_LT(x, 2);  // of the sphere\nEXPECT_NEAR(x, y, 1e-9);")
        self.bare("1e-9", "// Of something else.\n\nEXPECT_NEAR(x, y, 1e-9);\n// Of what follows.\n")
        self.bare("1e-9", 'EXPECT_NEAR(x, y, 1e-9) << "// no comment";')

    def test_a_named_function_is_a_reason_for_its_arguments_alone(self):
        self.reasoned("EXPECT_NEAR(x, y, rounding(20));")
        self.reasoned("EXPECT_LT(x, testing::rounding<float128>(1e-3 * n) * size);")
        self.reasoned("EXPECT_NEAR(x, y, reference(12, 0.01));")
        self.reasoned("EXPECT_NEAR(x, y, truncation(options.relative_tolerance, 100));")
        self.bare("rounding(20) + 1e-9", "EXPECT_NEAR(x, y, rounding(20) + 1e-9);")
        self.bare("truncation(1e-9, n)", "EXPECT_NEAR(x, y, truncation(1e-9, n));")

    def test_a_name_is_no_reason(self):
        self.bare("1e-9", "constexpr double kSlack = 1e-9;\nEXPECT_NEAR(x, y, kSlack);\nEXPECT_NEAR(x, z, kSlack);")
        self.bare("1e-8 * size", "// Elsewhere.\nconst double slack = 1e-9;\n}\nconst double slack = 1e-8 * size;\nEXPECT_LT(x, slack);")
        self.reasoned("// Nine digits are printed.\nconstexpr double kPrinted = 1e-9;\n\nEXPECT_NEAR(x, y, kPrinted);")

    def test_the_line_is_that_of_the_check_or_of_the_constant(self):
        self.assertEqual([line for line, _, _ in tolerances.literals("\n\nEXPECT_NEAR(x, y,\n1e-9);")], [3])
        self.assertEqual([line for line, _, _ in tolerances.literals("\nconst double s = 1e-9;\n\nEXPECT_NEAR(x, y, s);")], [2])

    def test_neither_more_nor_fewer(self):
        self.assertIsNone(tolerances.verdict(tolerances.MOST))
        self.assertIn(f"no more than {tolerances.MOST}: compute the new ones", tolerances.verdict(tolerances.MOST + 1))
        self.assertEqual(tolerances.verdict(tolerances.MOST - 1), f"Lower MOST in tests/tolerances.py to {tolerances.MOST - 1}.")


if __name__ == "__main__":
    unittest.main()
