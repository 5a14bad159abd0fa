// SPDX-License-Identifier: MIT
//
// How a contract is checked: the words stand in its header, and the compiler reads the calls.
#pragma once

#include <type_traits>

namespace fovea::hal {

namespace detail {

template <class Answer, template <class> class Call, class T, class = void>
struct Answers : std::false_type {};
template <class Answer, template <class> class Call, class T>
struct Answers<Answer, Call, T, std::void_t<Call<T>>> : std::is_same<Call<T>, Answer> {};

}  // namespace detail

/// True when the call of T exists and answers exactly Answer.
template <class Answer, template <class> class Call, class T>
inline constexpr bool answers_v = detail::Answers<Answer, Call, T>::value;

}  // namespace fovea::hal
