// The layers of one object of glass.
Layers layersOf(int object)
{
    uvec4 high = objectBits(object, VT_OBJECT_HIGH);
    return Layers(objectNumbers(object, VT_OBJECT_FRUSTUM), objectNumbers(object, VT_OBJECT_DEPTHS).xyz, objectNumbers(object, VT_OBJECT_LOW).xyz,
                  uintBitsToFloat(high.xyz), int(high.w));
}
