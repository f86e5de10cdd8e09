// In place of `Function` in the transcoder of basis.js (esbuild --inject, web/CMakeLists.txt): its glue, Emscripten's embind,
// makes the calls into WebAssembly of text, which the policy of a page may forbid. These do the same without text: they
// know the two kinds of calls that it makes by the names of their parameters.

/** A function or method of C++ for JavaScript. */
function makeInvoker(count, isMethod, [humanName, throwBindingError, invoker, target, runDestructors, retType, classParam, ...argTypes]) {
  return function (...values) {
    if (values.length !== count) throwBindingError(`function ${humanName} called with ${values.length} arguments, expected ${count}`);
    const destructors = [];
    const wired = isMethod ? [classParam.toWireType(destructors, this)] : [];
    values.forEach((value, i) => wired.push(argTypes[i].toWireType(destructors, value)));
    const result = invoker(target, ...wired);
    runDestructors(destructors);
    return retType.name === 'void' ? undefined : retType.fromWireType(result);
  };
}

/** A function or method of JavaScript for C++. */
function makeCaller(count, body, [retType, ...more]) {
  const argTypes = more.slice(0, count), returnValue = more[count];
  return (object, call, destructors, place) => {
    const values = argTypes.map((type) => {
      const value = type.readValueFromPointer(place);
      place += type.argPackAdvance;
      return value;
    });
    const isConstructor = body.includes('new func(');
    const result = isConstructor ? new call(...values) : body.includes('func.call(obj') ? call.call(object, ...values) : call.call(...values);
    return returnValue?.(retType, destructors, result);
  };
}

/** As the constructor `Function` of such a text. @param {...string} names of parameters, then the text */
function assemble(...names) {
  const body = names.pop(), count = names.filter((name) => name.startsWith('argType')).length;
  return (...values) => (names[0] === 'retType' ? makeCaller(count, body, values) : makeInvoker(count, body.includes('thisWired'), values));
}
Object.defineProperty(assemble, Symbol.hasInstance, { value: (value) => typeof value === 'function' });

export { assemble as Function };
