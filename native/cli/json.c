#include "cli/json.h"

#include <math.h>

/// Bytes of the UTF-8 character that a text begins with; 0: it is none (RFC 3629).
static int countBytes(const unsigned char* text)
{
    const unsigned first = text[0];
    const int count = first < 0x80   ? 1
                      : first < 0xc2 ? 0
                      : first < 0xe0 ? 2
                      : first < 0xf0 ? 3
                      : first < 0xf5 ? 4
                                     : 0;
    for (int i = 1; i < count; ++i) {
        if ((text[i] & 0xc0) != 0x80) {
            return 0;
        }
    }
    const bool isLong = (first == 0xe0 && text[1] < 0xa0) || (first == 0xf0 && text[1] < 0x90);
    const bool isNone = (first == 0xed && text[1] > 0x9f) || (first == 0xf4 && text[1] > 0x8f);
    return isLong || isNone ? 0 : count;
}

/// A byte that is no text, as names of files may have, becomes U+FFFD.
static void writeText(FILE* out, const char* text)
{
    fputc('"', out);
    for (const unsigned char* at = (const unsigned char*)text; *at != '\0';) {
        const int count = countBytes(at);
        if (count == 0) {
            fputs("\\ufffd", out);
        } else if (*at == '"' || *at == '\\') {
            fprintf(out, "\\%c", *at);
        } else if (*at < 32 || *at == 127) {
            fprintf(out, "\\u%04x", (unsigned)*at);
        } else {
            fwrite(at, 1, (size_t)count, out);
        }
        at += count > 0 ? count : 1;
    }
    fputc('"', out);
}

/// What comes before a value.
static void begin(vtJson* json, const char* name)
{
    fputs(json->follows ? "," : "", json->out);
    if (name != NULL) {
        writeText(json->out, name);
        fputc(':', json->out);
    }
    json->follows = true;
}

static void open(vtJson* json, const char* name, char bracket)
{
    begin(json, name);
    fputc(bracket, json->out);
    json->follows = false;
}

static void close(vtJson* json, char bracket)
{
    fputc(bracket, json->out);
    json->follows = true;
}

void vtJson_BeginObject(vtJson* json, const char* name)
{
    open(json, name, '{');
}

void vtJson_EndObject(vtJson* json)
{
    close(json, '}');
}

void vtJson_BeginArray(vtJson* json, const char* name)
{
    open(json, name, '[');
}

void vtJson_EndArray(vtJson* json)
{
    close(json, ']');
}

void vtJson_Text(vtJson* json, const char* name, const char* text)
{
    begin(json, name);
    writeText(json->out, text);
}

void vtJson_Integer(vtJson* json, const char* name, long long value)
{
    begin(json, name);
    fprintf(json->out, "%lld", value);
}

void vtJson_Number(vtJson* json, const char* name, double value, int decimals)
{
    begin(json, name);
    if (isfinite(value)) {
        fprintf(json->out, "%.*f", decimals, value);
    } else {
        fputs("null", json->out);
    }
}

void vtJson_Float(vtJson* json, const char* name, float value)
{
    begin(json, name);
    if (isfinite(value)) {
        fprintf(json->out, "%.9g", (double)value);
    } else {
        fputs("null", json->out);
    }
}
