#pragma once

/// Read before each source of Masked Occlusion Culling. It defines __cpuidex and _xgetbv, which
/// compilers of today have, too: here, its own get other names.
#include <cpuid.h>
#include <immintrin.h>

#define __cpuidex moc_cpuidex
#define _xgetbv moc_xgetbv
