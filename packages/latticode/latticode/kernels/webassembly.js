"use strict";

// Loads a module of webassembly.py in a browser or node, and passes arguments as numba does.

const STACK = 1 << 20; // address of the stack's start; constants and the stack are below, arrays above
const PAGES = 1024; // size of the memory in units of 64 KB

// Return three functions for a module: `array` creates an array of zeros in its memory, `clear`
// frees all arrays, and `call` runs the kernel. `outcome` is an array for the result; `inputs` are
// arrays and numbers, integers as BigInt. `call` returns 0, or the number of an error.
const loadKernel = async (code) => {
  const memory = new WebAssembly.Memory({ initial: PAGES });
  const env = {
    __linear_memory: memory,
    __stack_pointer: new WebAssembly.Global({ value: "i32", mutable: true }, STACK),
    // numba's runtime function: writes the strides of a reshaped array; all arrays are contiguous
    numba_attempt_nocopy_reshape: (rank, shape, strides, newRank, ...places) => {
      const [sizes, steps] = places.slice(0, 2).map((at) => new BigInt64Array(memory.buffer, at, Number(newRank)));
      sizes.reduceRight((stride, size, axis) => (steps[axis] = stride) * size, 8n);
      return 1;
    },
    // the double next to x > 0: the summand is 0.54 to 1.08 units in the last place
    numba_nextafter: (x, towards) => x + Math.sign(towards - x) * 1.2e-16 * x,
  };
  const { instance } = await WebAssembly.instantiate(code, { env });
  let free = STACK;
  const clear = () => { free = STACK; };
  // an array: its `values`, and the arguments `passed` for it to a kernel
  const array = (...shape) => {
    const count = shape.reduce((a, b) => a * b, 1);
    const strides = shape.map((_, axis) => shape.slice(axis + 1).reduce((a, b) => a * b, 8));
    const [place, numbers] = [free, shape.concat(strides).map(BigInt)];
    free += (8 * count + 63) & ~63;
    const values = new Float64Array(memory.buffer, place, count).fill(0);
    return { values, place, passed: [0, 0, BigInt(count), 8n, place, ...numbers] };
  };
  const call = (outcome, ...inputs) => {
    const passed = inputs.flatMap((input) => input.passed ?? input);
    return instance.exports.run(outcome.place, array(1).place, ...passed);
  };
  return { clear, array, call };
};
