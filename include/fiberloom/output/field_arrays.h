// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_field_arrays_h
#define fiberloom_output_field_arrays_h

#include <fiberloom/base/vector_types.h>

#include <vtkDataSetAttributes.h>
#include <vtkSmartPointer.h>

#include <string>

namespace fiberloom
{
  /** Adds an empty named array with one or three components to @p data . */
  template <class ArrayType>
  vtkSmartPointer<ArrayType>
  add_field_array(vtkDataSetAttributes *data,
                  const std::string    &name,
                  const int             n_components = 1)
  {
    auto array = vtkSmartPointer<ArrayType>::New();
    array->SetName(name.c_str());
    array->SetNumberOfComponents(n_components);
    data->AddArray(array);
    return array;
  }

  template <class ArrayType>
  void
  append_vector(ArrayType &array, const Vector3 &value)
  {
    array->InsertNextTuple3(value[0], value[1], value[2]);
  }
} // namespace fiberloom

#endif
