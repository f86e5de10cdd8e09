// The layers of one object of glass.
Layers layersOf(int object)
{
    uvec4 low = objectBits(object, VT_OBJECT_LOW);
    return Layers(objectNumbers(object, VT_OBJECT_FRUSTUM), objectNumbers(object, VT_OBJECT_DEPTHS).xyz, uintBitsToFloat(low.xyz),
                  objectNumbers(object, VT_OBJECT_HIGH).xyz, int(low.w));
}
