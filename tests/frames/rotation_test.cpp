// SPDX-License-Identifier: GPL-3.0-or-later
#include "frames/random_cases.hpp"

namespace earthtop {
namespace {

using test::close;
using test::identical;
using test::Random;

template <class T>
class RotationLaws : public ::testing::Test {
 protected:
  static T eps() { return real::epsilon<T>(); }
};
using Scalars = ::testing::Types<double, float80, float128>;
struct ScalarNames {
  template <class T>
  static std::string GetName(int) {
    return sizeof(T) == 8 ? "double" : std::is_same_v<T, float128> ? "float128" : "long_double";
  }
};
TYPED_TEST_SUITE(RotationLaws, Scalars, ScalarNames);

constexpr int kCases = 200;

TYPED_TEST(RotationLaws, TurnIsRightHanded) {
  using T = TypeParam;
  const Vec3<T> x = Vec3<T>::UnitX(), y = Vec3<T>::UnitY(), z = Vec3<T>::UnitZ();
  const T quarter = real::pi<T>() / T(2);
  EXPECT_TRUE(close<T>(Vec3<T>(Rotation<T>::about(z, quarter) * x), y, 4 * this->eps()));
  EXPECT_TRUE(close<T>(Vec3<T>(Rotation<T>::about(x, quarter) * y), z, 4 * this->eps()));
  EXPECT_TRUE(close<T>(Vec3<T>(Rotation<T>::about(y, quarter) * z), x, 4 * this->eps()));
}

TYPED_TEST(RotationLaws, ExpAndAboutAreRodriguesFormula) {
  using T = TypeParam;
  Random random(11);
  for (int k = 0; k < kCases; ++k) {
    const Vec3<T> n = random.unit<T>();
    const T angle = T(random.uniform(-6, 6));
    const Mat3<T> R = test::rodrigues(n, angle);
    // 16 eps: 3 products and 3 sums an entry on either side, and the sine and cosine of an angle up to 6 rounded by eps / 2.
    EXPECT_TRUE(close<T>(Rotation<T>::about(n, angle).matrix(), R, 16 * this->eps()));
    EXPECT_TRUE(close<T>(Rotation<T>::exp(angle * n).matrix(), R, 16 * this->eps()));
  }
}

TYPED_TEST(RotationLaws, MatrixIsOrthogonalWhateverTheNormOfTheQuaternion) {
  using T = TypeParam;
  Random random(12);
  for (int k = 0; k < kCases; ++k) {
    const Quaternion<T> q = random.quaternion<T>(1);
    const Mat3<T> R = rotation_matrix(q);
    EXPECT_TRUE(close<T>(Mat3<T>(R * R.transpose()), Mat3<T>::Identity(), 16 * this->eps()));
    EXPECT_TRUE(close<T>(R.col(0).cross(R.col(1)).dot(R.col(2)), T(1), 16 * this->eps()));
    const T size = T(random.uniform(0.1, 9));
    EXPECT_TRUE(close<T>(rotation_matrix(Quaternion<T>{size * q.w, size * q.v}), R, 16 * this->eps()));
    // A power of two changes no digit; the opposite quaternion is the same rotation.
    EXPECT_TRUE(identical(rotation_matrix(Quaternion<T>{T(-4) * q.w, T(-4) * q.v}), R));
  }
}

TYPED_TEST(RotationLaws, CompositionIsTheProductOfMatrices) {
  using T = TypeParam;
  Random random(13);
  for (int k = 0; k < kCases; ++k) {
    const Rotation<T> R_AB(random.quaternion<T>(0.7)), R_BC(random.quaternion<T>(1.9)), R_CD(random.quaternion<T>());
    EXPECT_TRUE(close<T>((R_AB * R_BC).matrix(), Mat3<T>(R_AB.matrix() * R_BC.matrix()), 16 * this->eps()));
    EXPECT_TRUE(close<T>(((R_AB * R_BC) * R_CD).matrix(), (R_AB * (R_BC * R_CD)).matrix(), 16 * this->eps()));
    const Vec3<T> v_C = random.vector<T>();
    EXPECT_TRUE(close<T>(Vec3<T>((R_AB * R_BC) * v_C), Vec3<T>(R_AB * (R_BC * v_C)), 32 * this->eps()));
  }
}

TYPED_TEST(RotationLaws, InverseUndoesAndReversesProducts) {
  using T = TypeParam;
  Random random(14);
  for (int k = 0; k < kCases; ++k) {
    const Rotation<T> R_AB(random.quaternion<T>(3)), R_BC(random.quaternion<T>());
    EXPECT_TRUE(identical(R_AB.inverse().matrix(), Mat3<T>(R_AB.matrix().transpose())));
    EXPECT_TRUE(close<T>((R_AB * R_AB.inverse()).matrix(), Mat3<T>::Identity(), 8 * this->eps()));
    EXPECT_TRUE(close<T>((R_AB * R_BC).inverse().matrix(), (R_BC.inverse() * R_AB.inverse()).matrix(), 16 * this->eps()));
  }
}

TYPED_TEST(RotationLaws, LogUndoesExp) {
  using T = TypeParam;
  EXPECT_TRUE(identical(Rotation<T>::exp(Vec3<T>::Zero()).log(), Vec3<T>::Zero()));
  EXPECT_TRUE(identical(Rotation<T>::exp(Vec3<T>::Zero()).matrix(), Mat3<T>::Identity()));
  Random random(15);
  const T pi = real::pi<T>();
  for (int k = 0; k < kCases; ++k) {
    const Vec3<T> n = random.unit<T>();
    const T arbitrary = T(random.uniform(0, 3.1));
    for (const T angle :
         {T(1e-300), T(1e-160), T(1e-8), arbitrary, pi - T(1e-3), pi - T(1e-10), pi * (T(1) - 8 * this->eps())}) {
      const Vec3<T> v = angle * n;
      // Relative to the angle itself: 16 eps for two norms, sine, cosine, arc tangent, and their quotients.
      EXPECT_TRUE(close<T>(Rotation<T>::exp(v).log(), v, 16 * this->eps() * angle)) << static_cast<double>(angle);
    }
  }
}

TYPED_TEST(RotationLaws, LogTakesTheShortWay) {
  using T = TypeParam;
  Random random(16);
  const T pi = real::pi<T>();
  for (int k = 0; k < kCases; ++k) {
    const Vec3<T> n = random.unit<T>();
    const T angle = T(random.uniform(3.15, 6.28));
    EXPECT_TRUE(close<T>(Rotation<T>::exp(angle * n).log(), Vec3<T>((angle - T(2) * pi) * n), 16 * this->eps() * angle));
    const Quaternion<T> q = random.quaternion<T>();
    EXPECT_TRUE(identical(Rotation<T>(q).log(), Rotation<T>(Quaternion<T>{-q.w, -q.v}).log()));
  }
  // Half a turn, exactly: |log| = pi.
  EXPECT_TRUE(
      close<T>(Rotation<T>(Quaternion<T>{T(0), Vec3<T>::UnitY()}).log(), Vec3<T>(T(0), pi, T(0)), 2 * this->eps() * pi));
}

TYPED_TEST(RotationLaws, SmallTurnsKeepEveryDigit) {
  using T = TypeParam;
  Random random(17);
  for (int k = 0; k < kCases; ++k) {
    const Vec3<T> v = T(1e-300) * random.unit<T>();
    const Mat3<T> R = Rotation<T>::exp(v).matrix();
    // R = 1 + [v]x + O(1e-600): the antisymmetric part must not be lost in the ones. 16 eps: norm, quotient, four products.
    EXPECT_TRUE(close<T>(Vec3<T>(R(2, 1), R(0, 2), R(1, 0)), v, 16 * this->eps() * norm(v)));
    EXPECT_TRUE(close<T>(Vec3<T>(R(1, 2), R(2, 0), R(0, 1)), Vec3<T>(-v), 16 * this->eps() * norm(v)));
  }
}

TYPED_TEST(RotationLaws, TurnsAboutOneAxisAdd) {
  using T = TypeParam;
  Random random(18);
  for (int k = 0; k < kCases; ++k) {
    const Vec3<T> n = random.unit<T>();
    const T a = T(random.uniform(-1.5, 1.5)), b = T(random.uniform(-1.5, 1.5));
    EXPECT_TRUE(close<T>((Rotation<T>::about(n, a) * Rotation<T>::about(n, b)).log(), Vec3<T>((a + b) * n), 32 * this->eps()));
  }
}

TYPED_TEST(RotationLaws, PiHasAllItsDigits) {
  using T = TypeParam;
  // Machin: pi = 16 atan(1/5) - 4 atan(1/239), by the series; 80 terms leave 5^-161.
  const auto arc_tangent_of_inverse = [](T x) {
    T sum = T(0), power = T(1) / x;
    for (int k = 0; k < 80; ++k, power /= -(x * x)) sum += power / T(2 * k + 1);
    return sum;
  };
  const T pi = T(16) * arc_tangent_of_inverse(T(5)) - T(4) * arc_tangent_of_inverse(T(239));
  EXPECT_TRUE(close<T>(real::pi<T>(), pi, 8 * this->eps()));  // 8 eps: the sum's leading terms are rounded at size 16/5
  EXPECT_EQ(T(1) + real::epsilon<T>() / T(2), T(1));
  EXPECT_NE(T(1) + real::epsilon<T>(), T(1));
}

TYPED_TEST(RotationLaws, HypotNeitherOverflowsNorUnderflows) {
  using T = TypeParam;
  for (const T size : {T(1e-300), T(1), T(1e300)}) {
    EXPECT_TRUE(close<T>(real::hypot(T(2) * size, T(-3) * size, T(6) * size), T(7) * size, 7 * 4 * this->eps() * size));
    EXPECT_TRUE(close<T>(real::hypot(T(-4) * size, T(3) * size), T(5) * size, 5 * 4 * this->eps() * size));
  }
  EXPECT_EQ(real::hypot(T(0), T(0), T(0)), T(0));
}

TYPED_TEST(RotationLaws, WrittenOutProductsAreEigens) {
  using T = TypeParam;
  Random random(19);
  for (int k = 0; k < kCases; ++k) {
    const Mat3<T> m = random.general_matrix<T>();
    const Mat3<T> R = rotation_matrix(random.quaternion<T>());
    const Vec3<T> u = random.vector<T>(), v = random.vector<T>();
    // Components at most 1: three products and two sums of at most 3 each; the tensor does it twice.
    EXPECT_TRUE(close<T>(times<T>(m, v), Vec3<T>(m * v), 6 * this->eps()));
    EXPECT_TRUE(close<T>(transposed_times<T>(m, v), Vec3<T>(m.transpose() * v), 6 * this->eps()));
    EXPECT_TRUE(close<T>(turned_tensor<T>(R, m), Mat3<T>(R * m * R.transpose()), 24 * this->eps()));
    EXPECT_TRUE(close<T>(Vec3<T>(cross_matrix<T>(u) * v), Vec3<T>(u.cross(v)), 4 * this->eps()));
  }
}

}  // namespace
}  // namespace earthtop
