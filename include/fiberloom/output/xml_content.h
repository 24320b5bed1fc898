// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_xml_content_h
#define fiberloom_output_xml_content_h

#include <fiberloom/base/exceptions.h>

#include <vtkDataObject.h>
#include <vtkNew.h>

#include <string>

namespace fiberloom
{
  /**
   * What one of VTK's writers of XML makes of @p data , compressed binary.
   * Throws StageFailure.
   */
  template <class Writer>
  std::string
  xml_content(vtkDataObject *data)
  {
    vtkNew<Writer> writer;
    writer->SetInputData(data);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToZLib();
    writer->WriteToOutputStringOn();
    if (writer->Write() == 0)
      throw StageFailure("a field could not be encoded for ParaView");
    return writer->GetOutputString();
  }
} // namespace fiberloom

#endif
