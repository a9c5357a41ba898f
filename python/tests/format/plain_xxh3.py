# SPDX-License-Identifier: Apache-2.0
"""XXH3-64 with seed 0 in plain Python, written from the xxHash specification: slow, independent."""

import struct

_SECRET = bytes.fromhex(
    "b8fe6c3923a44bbe7c01812cf721ad1cded46de9839097db7240a4a4b7b3671f"
    "cb79e64eccc0e578825ad07dccff7221b8084674f743248ee03590e6813a264c"
    "3c2852bb91c300cb88d0658b1b532ea371644897a20df94e3819ef46a9deacd8"
    "a8fa763fe39c343ff9dcbbc7c70b4f1d8a51e04bcdb45931c89f7ec9d9787364"
    "eac5ac8334d3ebc3c581a0fffa1363eb170ddd51b7f0da49d316552629d4689e"
    "2b16be587d47a1fc8ff8b8d17ad031ce45cb3a8f95160428afd7fbcabb4b407e"
)
_MASK = 2**64 - 1
_PRIMES32 = 0x9E3779B1, 0x85EBCA77, 0xC2B2AE3D
_PRIMES64 = (
    0x9E3779B185EBCA87,
    0xC2B2AE3D27D4EB4F,
    0x165667B19E3779F9,
    0x85EBCA77C2B2AE63,
    0x27D4EB2F165667C5,
)
_STRIPE = 64
_BLOCK = 1024


def _u32(data, at):
    return struct.unpack_from("<I", data, at)[0]


def _u64(data, at):
    return struct.unpack_from("<Q", data, at)[0]


def _fold(a, b):
    """The two halves of a 128-bit product, combined."""
    product = a * b
    return (product & _MASK) ^ (product >> 64)


def _rotate(x, bits):
    return (x << bits | x >> (64 - bits)) & _MASK


def _reverse(x):
    return int.from_bytes(x.to_bytes(8, "little"), "big")


def _avalanche(h):
    h ^= h >> 37
    h = h * 0x165667919E3779F9 & _MASK
    return h ^ h >> 32


def _avalanche_xxh64(h):
    h ^= h >> 33
    h = h * _PRIMES64[1] & _MASK
    h ^= h >> 29
    h = h * _PRIMES64[2] & _MASK
    return h ^ h >> 32


def _mix(data, at, secret):
    return _fold(
        _u64(data, at) ^ _u64(_SECRET, secret), _u64(data, at + 8) ^ _u64(_SECRET, secret + 8)
    )


def _short(data):
    """Up to 16 bytes."""
    n = len(data)
    if n == 0:
        return _avalanche_xxh64(_u64(_SECRET, 56) ^ _u64(_SECRET, 64))
    if n <= 3:
        word = data[0] << 16 | data[n >> 1] << 24 | data[-1] | n << 8
        return _avalanche_xxh64(word ^ _u32(_SECRET, 0) ^ _u32(_SECRET, 4))
    if n <= 8:
        word = _u32(data, n - 4) + (_u32(data, 0) << 32)
        h = word ^ _u64(_SECRET, 8) ^ _u64(_SECRET, 16)
        h ^= _rotate(h, 49) ^ _rotate(h, 24)
        h = h * 0x9FB21C651E98DF25 & _MASK
        h ^= (h >> 35) + n
        h = h * 0x9FB21C651E98DF25 & _MASK
        return h ^ h >> 28
    low = _u64(data, 0) ^ _u64(_SECRET, 24) ^ _u64(_SECRET, 32)
    high = _u64(data, n - 8) ^ _u64(_SECRET, 40) ^ _u64(_SECRET, 48)
    return _avalanche((n + _reverse(low) + high + _fold(low, high)) & _MASK)


def _middle(data):
    """17 to 240 bytes."""
    n = len(data)
    h = n * _PRIMES64[0]
    if n <= 128:
        for i in range((n - 1) // 32, -1, -1):
            h += _mix(data, 16 * i, 32 * i) + _mix(data, n - 16 * (i + 1), 32 * i + 16)
        return _avalanche(h & _MASK)
    for i in range(8):
        h += _mix(data, 16 * i, 16 * i)
    h = _avalanche(h & _MASK)
    for i in range(8, n // 16):
        h += _mix(data, 16 * i, 16 * (i - 8) + 3)
    return _avalanche((h + _mix(data, n - 16, 136 - 17)) & _MASK)


def _accumulate(lanes, data, at, secret):
    for i in range(8):
        value = _u64(data, at + 8 * i)
        keyed = value ^ _u64(_SECRET, secret + 8 * i)
        lanes[i ^ 1] = (lanes[i ^ 1] + value) & _MASK
        lanes[i] = (lanes[i] + (keyed & 0xFFFFFFFF) * (keyed >> 32)) & _MASK


def _long(data):
    """More than 240 bytes: stripes of 64, in blocks of 16 stripes."""
    p32, p64, n = _PRIMES32, _PRIMES64, len(data)
    lanes = [p32[2], p64[0], p64[1], p64[2], p64[3], p32[1], p64[4], p32[0]]
    for stripe in range((n - 1) // _STRIPE):
        of_block = stripe % (_BLOCK // _STRIPE)
        if stripe > 0 and of_block == 0:
            _scramble(lanes)
        _accumulate(lanes, data, stripe * _STRIPE, 8 * of_block)
    if (n - 1) // _STRIPE % (_BLOCK // _STRIPE) == 0:
        _scramble(lanes)
    _accumulate(lanes, data, n - _STRIPE, len(_SECRET) - _STRIPE - 7)
    h = n * p64[0]
    for i in range(4):
        secret = 11 + 16 * i
        h += _fold(
            lanes[2 * i] ^ _u64(_SECRET, secret), lanes[2 * i + 1] ^ _u64(_SECRET, secret + 8)
        )
    return _avalanche(h & _MASK)


def _scramble(lanes):
    for i in range(8):
        lane = lanes[i] ^ lanes[i] >> 47 ^ _u64(_SECRET, len(_SECRET) - _STRIPE + 8 * i)
        lanes[i] = lane * _PRIMES32[0] & _MASK


def xxh3_64(data):
    data = bytes(data)
    if len(data) <= 16:
        return _short(data)
    return _middle(data) if len(data) <= 240 else _long(data)
