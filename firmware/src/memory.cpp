// Copying and filling for a Cortex-M7, in place of the library's: the state of the core moves in doubles, 64 bytes at a
// time.
//
// The library's take two instructions for four bytes; a structure of the core has a hundred or more. The registers of
// the floating-point unit used here are those that any call may change. What is not aligned to words, which no
// structure of the core is, goes byte by byte.

asm(R"(
    .syntax unified
    .thumb

    .section .text.memcpy, "ax", %progbits
    .global memcpy
    .type memcpy, %function
    .thumb_func
memcpy:                             @ r0: to, r1: from, r2: bytes
    orr     r3, r0, r1
    mov     ip, r0
    lsls    r3, r3, #30
    bne     3f
    subs    r2, r2, #64
    blo     2f
1:  vldmia  r1!, {d0-d7}
    vstmia  ip!, {d0-d7}
    subs    r2, r2, #64
    bhs     1b
2:  tst     r2, #48                 @ what is left, by its bits
    beq     6f
    lsls    r3, r2, #27             @ carry 32, negative 16
    itt     cs
    vldmiacs r1!, {d0-d3}
    vstmiacs ip!, {d0-d3}
    itt     mi
    vldmiami r1!, {d0-d1}
    vstmiami ip!, {d0-d1}
6:  lsls    r3, r2, #29             @ 8, 4
    itt     cs
    vldmiacs r1!, {d0}
    vstmiacs ip!, {d0}
    itt     mi
    ldrmi   r3, [r1], #4
    strmi   r3, [ip], #4
    lsls    r3, r2, #30             @ whole words, as nearly always
    it      eq
    bxeq    lr
    lsls    r3, r2, #31             @ 2, 1
    itt     cs
    ldrhcs  r3, [r1], #2
    strhcs  r3, [ip], #2
    itt     mi
    ldrbmi  r3, [r1]
    strbmi  r3, [ip]
    bx      lr
3:  cbz     r2, 5f
4:  ldrb    r3, [r1], #1
    strb    r3, [ip], #1
    subs    r2, r2, #1
    bne     4b
5:  bx      lr
    .size memcpy, . - memcpy

    .section .text.memset, "ax", %progbits
    .global memset
    .type memset, %function
    .thumb_func
memset:                             @ r0: to, r1: byte, r2: bytes
    mov     ip, r0
    uxtb    r1, r1
    lsls    r3, r0, #30
    bne     3f
    orr     r1, r1, r1, lsl #8
    orr     r1, r1, r1, lsl #16
    vmov    d0, r1, r1
    vmov.f64 d1, d0
    vmov.f64 d2, d0
    vmov.f64 d3, d0
    subs    r2, r2, #64
    blo     2f
1:  vstmia  ip!, {d0-d3}
    vstmia  ip!, {d0-d3}
    subs    r2, r2, #64
    bhs     1b
2:  lsls    r3, r2, #27             @ what is left, by its bits: carry 32, negative 16
    it      cs
    vstmiacs ip!, {d0-d3}
    it      mi
    vstmiami ip!, {d0-d1}
    lsls    r3, r2, #29             @ 8, 4
    it      cs
    vstmiacs ip!, {d0}
    it      mi
    strmi   r1, [ip], #4
    lsls    r3, r2, #30             @ whole words, as nearly always
    it      eq
    bxeq    lr
    lsls    r3, r2, #31             @ 2, 1
    it      cs
    strhcs  r1, [ip], #2
    it      mi
    strbmi  r1, [ip]
    bx      lr
3:  cbz     r2, 5f
4:  strb    r1, [ip], #1
    subs    r2, r2, #1
    bne     4b
5:  bx      lr
    .size memset, . - memset
)");
