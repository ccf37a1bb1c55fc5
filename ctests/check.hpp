// The test macros of check.h, and the status with which calls of C++ end, thrown or not.
#ifndef CAGEDYN_CHECK_HPP
#define CAGEDYN_CHECK_HPP

#include "cagedyn.hpp"
#include "check.h"

#ifdef CAGEDYN_NO_EXCEPTIONS
template <class F> inline std::int32_t status_of(F &&call)
{
    call();
    return cagedyn::last_status();
}
#else
template <class F> inline std::int32_t status_of(F &&call)
{
    try {
        call();
        return CAGEDYN_OK;
    } catch (const cagedyn::Error &error) {
        CHECK(error.what()[0] != '\0' && error.name().substr(0, 4) == "ERR_");
        return error.status();
    }
}
#endif

#endif
