#include "vtkio/vtk_messages.h"

#include "base/error.h"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>

#include <algorithm>
#include <fstream>
#include <vector>

namespace isoglass {

namespace {

/// Where VTK sends its messages.
class MessageWindow : public vtkOutputWindow {
  public:
    static MessageWindow* New() {
        auto* made = new MessageWindow;
        made->InitializeObjectBase();
        return made;
    }

    void DisplayText(const char* text) override { messages.emplace_back(text ? text : ""); }

    std::vector<std::string> messages;
};

MessageWindow& window() {
    return static_cast<MessageWindow&>(*vtkOutputWindow::GetInstance());
}

/// "ERROR: In file.cxx, line 12\nvtkReader (0x...): what happened\n\n" without all before what happened.
std::string reason(const std::string& message) {
    const std::size_t newline = message.find('\n');
    std::string text = newline == std::string::npos ? message : message.substr(newline + 1);
    if (const std::size_t object = text.find("): "); object != std::string::npos)
        text = text.substr(object + 3);
    for (char& letter : text)
        if (letter == '\n') letter = ' ';
    return text.substr(0, text.find_last_not_of(' ') + 1);
}

}  // namespace

VtkMessages::VtkMessages() {
    // Its log prints errors too, whatever the window does with them.
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    const vtkNew<MessageWindow> messages;
    vtkOutputWindow::SetInstance(messages);
}

VtkMessages::~VtkMessages() {
    vtkOutputWindow::SetInstance(nullptr);
}

void VtkMessages::throwIfAny(const std::string& file) const {
    if (window().messages.empty()) return;
    throw Error("VTK cannot read it: " + reason(window().messages.front()), file,
                "the file may be cut off or damaged");
}

void requireWholeXml(const std::filesystem::path& file) {
    constexpr std::streamoff kTailBytes = 256;
    std::ifstream stream(file, std::ios::binary | std::ios::ate);
    if (!stream) throw Error("cannot be opened", file.string());
    const std::streamoff size = stream.tellg();
    std::string tail(static_cast<std::size_t>(std::min(size, kTailBytes)), '\0');
    stream.seekg(size - static_cast<std::streamoff>(tail.size()));
    stream.read(tail.data(), static_cast<std::streamsize>(tail.size()));
    tail.erase(tail.find_last_not_of(" \t\r\n") + 1);
    if (!tail.ends_with("</VTKFile>"))
        throw Error("it does not end with </VTKFile>", file.string(), "the file may be cut off or damaged");
}

}  // namespace isoglass
