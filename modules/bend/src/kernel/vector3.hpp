// SPDX-License-Identifier: MIT
#pragma once

/// Vectors in space, one in each lane of the registers of lanes `L`.

namespace goffer::bend {

template <class L>
struct Vector3 {
    typename L::Vec x, y, z;
};

/// a u + b v
template <class L>
Vector3<L> combined(typename L::Vec a, const Vector3<L>& u, typename L::Vec b, const Vector3<L>& v) {
    return {L::madd(a, u.x, b * v.x), L::madd(a, u.y, b * v.y), L::madd(a, u.z, b * v.z)};
}

template <class L>
Vector3<L> sum(const Vector3<L>& u, const Vector3<L>& v) {
    return {u.x + v.x, u.y + v.y, u.z + v.z};
}

template <class L>
typename L::Vec dot(const Vector3<L>& u, const Vector3<L>& v) {
    return L::madd(u.x, v.x, L::madd(u.y, v.y, u.z * v.z));
}

template <class L>
Vector3<L> cross(const Vector3<L>& u, const Vector3<L>& v) {
    return {L::nmadd(u.z, v.y, u.y * v.z), L::nmadd(u.x, v.z, u.z * v.x), L::nmadd(u.y, v.x, u.x * v.y)};
}

template <class L>
typename L::Vec largest(const Vector3<L>& v) {
    return L::max(L::max(L::abs(v.x), L::abs(v.y)), L::abs(v.z));
}

template <class L>
Vector3<L> scaled(typename L::Vec by, const Vector3<L>& v) {
    return {by * v.x, by * v.y, by * v.z};
}

}  // namespace goffer::bend
