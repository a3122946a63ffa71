"use strict";

// What runs a module of webassembly.py: a browser, or node. It knows how numba passes arguments.

const STACK = 1 << 20; // the constants of a module and its stack lie below, arrays above
const PAGES = 1024; // of the memory, 64 KB each

// Return functions of a module: `array` makes zeros of a shape in its memory, `clear` frees all
// arrays, and `call` runs the kernel. `outcome` is an array for the result; `given` are arrays and
// numbers, whole ones as BigInt. The call returns 0, or the number of an error.
const loadKernel = async (code) => {
  const memory = new WebAssembly.Memory({ initial: PAGES });
  const env = {
    __linear_memory: memory,
    __stack_pointer: new WebAssembly.Global({ value: "i32", mutable: true }, STACK),
    // writes the strides of an array in another shape, as numba's runtime does: all are contiguous
    numba_attempt_nocopy_reshape: (rank, shape, strides, newRank, ...places) => {
      const [sizes, steps] = places.slice(0, 2).map((at) => new BigInt64Array(memory.buffer, at, Number(newRank)));
      sizes.reduceRight((stride, size, axis) => (steps[axis] = stride) * size, 8n);
      return 1;
    },
    // the number next to x > 0: what is added has 0.54 to 1.08 units of its last place
    numba_nextafter: (x, towards) => x + Math.sign(towards - x) * 1.2e-16 * x,
  };
  const { instance } = await WebAssembly.instantiate(code, { env });
  let free = STACK;
  const clear = () => { free = STACK; };
  // the numbers, and what numba passes to a kernel for such an array
  const array = (...shape) => {
    const count = shape.reduce((a, b) => a * b, 1);
    const strides = shape.map((_, axis) => shape.slice(axis + 1).reduce((a, b) => a * b, 8));
    const [place, numbers] = [free, shape.concat(strides).map(BigInt)];
    free += (8 * count + 63) & ~63;
    const values = new Float64Array(memory.buffer, place, count).fill(0);
    return { values, place, passed: [0, 0, BigInt(count), 8n, place, ...numbers] };
  };
  const call = (outcome, ...given) => {
    const passed = given.flatMap((one) => one.passed ?? one);
    return instance.exports.run(outcome.place, array(1).place, ...passed);
  };
  return { clear, array, call };
};
